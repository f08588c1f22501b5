#include "common/mesh/simplify_closed.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ramify {
namespace {

// A sweep in which a smaller part of the vertices goes is the last.
constexpr double kWorthwhile = 0.02;

// Cosine of the greatest angle between a triangle and the normals of its vertices.
constexpr float kFacing = 0.8f;

// 4 sqrt(3) area / sum of squared sides: 1 for an equilateral triangle.
constexpr float kQuality = 0.3f;

// A cell of a grid has twelve edges, each with two of its vertex's triangles at most.
constexpr std::size_t kRoom = 24;
constexpr std::size_t kValenceMax = 14;

constexpr std::uint32_t kNone = 0xffffffff;

/// The triangles around a vertex.
struct Star {
  std::uint32_t count = 0;
  std::array<std::uint32_t, kRoom> triangles;

  void add(std::uint32_t triangle) {
    assert(count < kRoom);
    triangles[count++] = triangle;
  }
  void remove(std::uint32_t triangle) {
    auto* const last = triangles.begin() + count;
    auto* const found = std::find(triangles.begin(), last, triangle);
    if (found == last) return;
    std::move(found + 1, last, found);
    --count;
  }
  const std::uint32_t* begin() const { return triangles.data(); }
  const std::uint32_t* end() const { return triangles.data() + count; }
};

bool has(const Triangle& triangle, std::uint32_t vertex) {
  return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
}

class Collapser {
 public:
  Collapser(CollapsibleMesh& mesh, float tolerance)
      : mesh_(mesh), tolerance_(tolerance), stars_(mesh.positions.size()) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const std::uint32_t vertex : mesh.triangles[t]) stars_[vertex].add(t);
    }
  }

  void run() {
    std::size_t left = mesh_.positions.size();
    for (;;) {
      const std::size_t gone = sweep();
      if (gone == 0 || static_cast<double>(gone) < kWorthwhile * static_cast<double>(left)) break;
      left -= gone;
    }
    const auto is_gone = [](const Triangle& triangle) { return triangle[0] == kNone; };
    auto& triangles = mesh_.triangles;
    triangles.erase(std::remove_if(triangles.begin(), triangles.end(), is_gone), triangles.end());
  }

 private:
  /// Two vertices around v that follow it in a triangle, with all that a collapse asks of them.
  struct Side {
    std::uint32_t a, b;
    Vec3f at_a, at_b;
    Vec3f normal_a, normal_b;
  };

  struct Collapse {
    std::uint32_t target = kNone;
    float quality = 0.0f;  // of the worst new triangle; 0 where the collapse is not allowed
    float error = 0.0f;    // how far the surface has moved then
  };

  /// Collapses that do not touch each other; returns how many.
  std::size_t sweep() {
    is_touched_.assign(stars_.size(), false);
    std::size_t gone = 0;
    for (std::uint32_t v = 0; v < stars_.size(); ++v) {
      Freedom& own = mesh_.freedom[v];
      if (!own.can_go || !own.is_whole || own.is_settled || stars_[v].count == 0 || is_near_change(v))
        continue;
      const Collapse wish = wish_of(v);
      if (wish.target == kNone) {
        own.is_settled = true;
        continue;
      }
      commit(v, wish);
      ++gone;
    }
    return gone;
  }

  /// Whether something around v has changed in this sweep: it has its turn in the next one, so that what goes
  /// is spread evenly.
  bool is_near_change(std::uint32_t v) const {
    if (is_touched_[v]) return true;
    for (const std::uint32_t t : stars_[v]) {
      for (const std::uint32_t vertex : mesh_.triangles[t]) {
        if (is_touched_[vertex]) return true;
      }
    }
    return false;
  }

  Collapse wish_of(std::uint32_t v) {
    if (stars_[v].count > kValenceMax) return {};
    sides_.clear();
    for (const std::uint32_t t : stars_[v]) {
      const Triangle& triangle = mesh_.triangles[t];
      const std::size_t at = triangle[0] == v ? 0 : (triangle[1] == v ? 1 : 2);
      const std::uint32_t a = triangle[(at + 1) % 3];
      const std::uint32_t b = triangle[(at + 2) % 3];
      sides_.push_back({a, b, mesh_.positions[a], mesh_.positions[b], mesh_.normals[a], mesh_.normals[b]});
    }
    Collapse best;
    for (const Side& side : sides_) {
      if (!mesh_.freedom[side.a].is_whole) continue;
      const Collapse one = outcome(v, side);
      if (one.quality > best.quality && keeps_manifold(v, one.target)) best = one;
    }
    return best;
  }

  /// Of the collapse of v to the side's first end.
  Collapse outcome(std::uint32_t v, const Side& onto) const {
    const Vec3f shift = mesh_.positions[v] - onto.at_a;
    Collapse result{onto.a, 1.0f, 0.0f};
    for (const Side& side : sides_) {
      if (side.a == onto.a || side.b == onto.a) continue;
      const Vec3f first = side.at_a - onto.at_a;
      const Vec3f second = side.at_b - onto.at_a;
      const Vec3f cross = glm::cross(first, second);
      const float area = glm::length(cross);
      const float facing = kFacing * area;
      if (!(area > 0.0f) || glm::dot(cross, onto.normal_a) < facing ||
          glm::dot(cross, side.normal_a) < facing || glm::dot(cross, side.normal_b) < facing) {
        return {};
      }
      const Vec3f third = second - first;
      const float squares = glm::dot(first, first) + glm::dot(second, second) + glm::dot(third, third);
      result.quality = std::min(result.quality, 2.0f * std::numbers::sqrt3_v<float> * area / squares);
      result.error = std::max(result.error, std::abs(glm::dot(cross, shift)) / area);
      if (result.quality < kQuality || result.error + mesh_.errors[v] > tolerance_) return {};
    }
    result.error += mesh_.errors[v];
    return result;
  }

  /// v and the target have no neighbours in common but the two across their edge, and those keep three
  /// triangles.
  bool keeps_manifold(std::uint32_t v, std::uint32_t target) const {
    if (stars_[v].count + stars_[target].count > kValenceMax + 4) return false;
    std::size_t common = 0;
    for (const Side& side : sides_) {
      if (side.a == target) continue;
      const bool is_common = std::any_of(stars_[target].begin(), stars_[target].end(),
                                         [&](std::uint32_t t) { return has(mesh_.triangles[t], side.a); });
      if (!is_common) continue;
      ++common;
      if (stars_[side.a].count < 4) return false;
    }
    return common == 2;
  }

  void commit(std::uint32_t v, const Collapse& collapse) {
    const Star star = stars_[v];
    for (const std::uint32_t t : star) {
      Triangle& triangle = mesh_.triangles[t];
      for (const std::uint32_t vertex : triangle) {
        is_touched_[vertex] = true;
        mesh_.freedom[vertex].is_settled = false;
      }
      if (has(triangle, collapse.target)) {
        for (const std::uint32_t vertex : triangle) stars_[vertex].remove(t);
        triangle = {kNone, kNone, kNone};
      } else {
        std::replace(triangle.begin(), triangle.end(), v, collapse.target);
        stars_[collapse.target].add(t);
      }
    }
    stars_[v].count = 0;
    mesh_.errors[collapse.target] = std::max(mesh_.errors[collapse.target], collapse.error);
  }

  CollapsibleMesh& mesh_;
  float tolerance_;
  std::vector<Star> stars_;
  std::vector<bool> is_touched_;
  std::vector<Side> sides_;  // scratch
};

}  // namespace

void simplify_closed(CollapsibleMesh& mesh, double tolerance) {
  Collapser(mesh, static_cast<float>(tolerance)).run();
}

std::vector<std::uint32_t> drop_unused(std::vector<bool> is_kept, BulkVector<Triangle>& triangles) {
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t vertex : triangle) is_kept[vertex] = true;
  }
  std::vector<std::uint32_t> place(is_kept.size(), kNone);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t v = 0; v < is_kept.size(); ++v) {
    if (!is_kept[v]) continue;
    place[v] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(v);
  }
  for (Triangle& triangle : triangles) {
    for (std::uint32_t& vertex : triangle) vertex = place[vertex];
  }
  return kept;
}

}  // namespace ramify
