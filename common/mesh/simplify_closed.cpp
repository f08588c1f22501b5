#include "common/mesh/simplify_closed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "common/base/parallel.h"

namespace ramify {
namespace {

// A pass in which a smaller part of the vertices goes is the last.
constexpr double kWorthwhile = 0.02;

// Cosine of the greatest angle between a triangle and the normals of its vertices.
constexpr float kFacing = 0.8f;

// 4 sqrt(3) area / sum of squared sides: 1 for an equilateral triangle.
constexpr float kQuality = 0.3f;

constexpr std::size_t kValenceMax = 14;

constexpr std::uint32_t kNone = 0xffffffff;

using Triangle = std::array<std::uint32_t, 3>;

/// The triangles around each vertex.
struct Stars {
  std::vector<std::uint32_t> first;  // of each vertex; one more at the end
  std::vector<std::uint32_t> triangles;

  Stars(std::size_t vertices, std::span<const Triangle> all)
      : first(vertices + 1, 0), triangles(3 * all.size()) {
    for (const Triangle& triangle : all) {
      for (const std::uint32_t vertex : triangle) ++first[vertex + 1];
    }
    for (std::size_t v = 0; v < vertices; ++v) first[v + 1] += first[v];
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t t = 0; t < all.size(); ++t) {
      for (const std::uint32_t vertex : all[t]) triangles[next[vertex]++] = t;
    }
  }

  std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return std::span(triangles).subspan(first[vertex], first[vertex + 1] - first[vertex]);
  }
};

/// Where a vertex may go, and how far the surface moves then.
struct Collapse {
  std::uint32_t target = kNone;
  float error = 0.0f;
};

/// One round of collapses that do not touch each other.
class Pass {
 public:
  /// `is_settled`: vertices that found no way to go, and around which nothing has changed since.
  Pass(ClosedSurface& surface, std::vector<float>& error, std::vector<std::uint8_t>& is_settled,
       float tolerance)
      : surface_(surface),
        error_(error),
        is_settled_(is_settled),
        tolerance_(tolerance),
        stars_(surface.positions.size(), surface.triangles) {}

  /// Returns how many vertices went. Their triangles are left degenerate.
  std::size_t run() {
    const std::size_t count = surface_.positions.size();
    std::vector<Collapse> wishes(count);
    parallel_for(count, 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        if (is_settled_[v] != 0) continue;
        wishes[v] = wish_of(static_cast<std::uint32_t>(v));
        is_settled_[v] = wishes[v].target == kNone;
      }
    });
    std::vector<bool> is_touched(count, false);
    std::size_t gone = 0;
    for (std::uint32_t v = 0; v < count; ++v) {
      if (wishes[v].target == kNone || !is_free(v, wishes[v].target, is_touched)) continue;
      commit(v, wishes[v], is_touched);
      ++gone;
    }
    return gone;
  }

 private:
  static bool has(const Triangle& triangle, std::uint32_t vertex) {
    return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
  }

  std::array<Vec3f, 3> corners(const Triangle& triangle) const {
    return {surface_.positions[triangle[0]], surface_.positions[triangle[1]],
            surface_.positions[triangle[2]]};
  }

  Collapse wish_of(std::uint32_t v) const {
    const std::span<const std::uint32_t> star = stars_.of(v);
    if (star.empty() || star.size() > kValenceMax) return {};
    Collapse best;
    float best_quality = 0.0f;
    for (const std::uint32_t t : star) {
      const Triangle& triangle = surface_.triangles[t];
      // Each neighbour follows v in one triangle.
      const auto at =
          static_cast<std::size_t>(std::find(triangle.begin(), triangle.end(), v) - triangle.begin());
      const std::uint32_t target = triangle[(at + 1) % 3];
      const auto [quality, error] = outcome(v, target);
      if (quality > best_quality && keeps_manifold(v, target)) {
        best = {target, error};
        best_quality = quality;
      }
    }
    return best;
  }

  struct Outcome {
    float quality = 0.0f;  // of the worst new triangle; 0 where the collapse is not allowed
    float error = 0.0f;
  };

  Outcome outcome(std::uint32_t v, std::uint32_t target) const {
    Outcome result{1.0f, 0.0f};
    const Vec3f shift = surface_.positions[v] - surface_.positions[target];
    for (const std::uint32_t t : stars_.of(v)) {
      Triangle triangle = surface_.triangles[t];
      if (has(triangle, target)) continue;
      std::replace(triangle.begin(), triangle.end(), v, target);
      const auto [a, b, c] = corners(triangle);
      const Vec3f cross = glm::cross(b - a, c - a);
      const float area = glm::length(cross);
      if (!(area > 0.0f)) return {};
      const Vec3f normal = cross / area;
      for (const std::uint32_t corner : triangle) {
        if (glm::dot(normal, surface_.normals[corner]) < kFacing) return {};
      }
      const auto squared = [](const Vec3f& side) { return glm::dot(side, side); };
      const float sides = squared(b - a) + squared(c - b) + squared(a - c);
      result.quality = std::min(result.quality, 2.0f * std::numbers::sqrt3_v<float> * area / sides);
      result.error = std::max(result.error, std::abs(glm::dot(normal, shift)));
    }
    result.error += error_[v];
    if (result.quality < kQuality || result.error > tolerance_) return {};
    return result;
  }

  /// v and the target have no neighbours in common but the two across their edge, and those keep three
  /// triangles.
  bool keeps_manifold(std::uint32_t v, std::uint32_t target) const {
    if (stars_.of(v).size() + stars_.of(target).size() > kValenceMax + 4) return false;
    std::size_t common = 0;
    for (const std::uint32_t t : stars_.of(v)) {
      const Triangle& triangle = surface_.triangles[t];
      const auto at =
          static_cast<std::size_t>(std::find(triangle.begin(), triangle.end(), v) - triangle.begin());
      const std::uint32_t neighbour = triangle[(at + 1) % 3];
      if (neighbour == target) continue;
      const std::span<const std::uint32_t> others = stars_.of(target);
      const bool is_common = std::any_of(others.begin(), others.end(), [&](std::uint32_t other) {
        return has(surface_.triangles[other], neighbour);
      });
      if (!is_common) continue;
      ++common;
      if (stars_.of(neighbour).size() < 4) return false;
    }
    return common == 2;
  }

  /// Nothing that the wish rests on has changed in this pass.
  bool is_free(std::uint32_t v, std::uint32_t target, const std::vector<bool>& is_touched) const {
    if (is_touched[v] || is_touched[target]) return false;
    for (const std::uint32_t t : stars_.of(v)) {
      for (const std::uint32_t vertex : surface_.triangles[t]) {
        if (is_touched[vertex]) return false;
      }
    }
    return true;
  }

  void commit(std::uint32_t v, const Collapse& collapse, std::vector<bool>& is_touched) {
    for (const std::uint32_t t : stars_.of(v)) {
      Triangle& triangle = surface_.triangles[t];
      for (const std::uint32_t vertex : triangle) {
        is_touched[vertex] = true;
        is_settled_[vertex] = 0;
      }
      const bool vanishes = has(triangle, collapse.target);
      std::replace(triangle.begin(), triangle.end(), v, collapse.target);
      if (vanishes) triangle = {kNone, kNone, kNone};
    }
    error_[collapse.target] = std::max(error_[collapse.target], collapse.error);
  }

  ClosedSurface& surface_;
  std::vector<float>& error_;
  std::vector<std::uint8_t>& is_settled_;
  float tolerance_;
  Stars stars_;
};

template <class T>
void keep_only(const std::vector<std::uint32_t>& kept, std::vector<T>& values) {
  for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
  values.resize(kept.size());
}

}  // namespace

void simplify_closed(ClosedSurface& surface, double tolerance) {
  std::vector<float> error(surface.positions.size(), 0.0f);
  std::vector<std::uint8_t> is_settled(surface.positions.size(), 0);
  for (;;) {
    const std::size_t before = surface.positions.size();
    const std::size_t gone = Pass(surface, error, is_settled, static_cast<float>(tolerance)).run();
    const auto is_gone = [](const Triangle& triangle) { return triangle[0] == kNone; };
    auto& triangles = surface.triangles;
    triangles.erase(std::remove_if(triangles.begin(), triangles.end(), is_gone), triangles.end());
    const std::vector<std::uint32_t> kept = drop_unused_vertices(surface);
    keep_only(kept, error);
    keep_only(kept, is_settled);
    if (static_cast<double>(gone) < kWorthwhile * static_cast<double>(before)) return;
  }
}

}  // namespace ramify
