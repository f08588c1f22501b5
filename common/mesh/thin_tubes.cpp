#include "common/mesh/thin_tubes.h"

#include <algorithm>
#include <cmath>

#include "common/mesh/wood.h"

namespace ramify {
namespace {

/// A place on a tube's centre line.
struct Stop {
  Vec3 at;
  double radius;
  std::uint32_t internode;
};

class TubeAdder {
 public:
  TubeAdder(int sides, Mesh& mesh) : sides_(static_cast<std::uint32_t>(sides)), mesh_(mesh) {}

  void add(const std::vector<Stop>& stops) {
    Vec3 tangent = direction(stops, 0);
    Vec3 side = any_perpendicular(tangent);
    float v = 0.0f;
    add_point(stops.front(), stops.front().at, -tangent, {0.0f, v});
    for (std::size_t i = 0; i < stops.size(); ++i) {
      const Vec3 next = i + 1 < stops.size() ? direction(stops, i) : tangent;
      const Vec3 along = normalized_or(tangent + next, next);
      side = transported(side, tangent, along);
      if (i > 0) {
        const double girth = std::numbers::pi * (stops[i].radius + stops[i - 1].radius);
        v += static_cast<float>(glm::length(stops[i].at - stops[i - 1].at) / girth);
      }
      add_ring(stops[i], along, side, v);
      side = transported(side, along, next);
      tangent = next;
      if (i > 0) join(last_ring() - (sides_ + 1), last_ring());
    }
    const auto first_ring = static_cast<std::uint32_t>(last_ring() - (stops.size() - 1) * (sides_ + 1));
    close(first_ring - 1, first_ring, true);
    add_point(stops.back(), stops.back().at, tangent, {0.0f, v});
    const auto tip = static_cast<std::uint32_t>(mesh_.vertex_count() - 1);
    close(tip, tip - (sides_ + 1), false);
  }

 private:
  static Vec3 direction(const std::vector<Stop>& stops, std::size_t from) {
    return normalized_or(stops[from + 1].at - stops[from].at, kUp, 1e-12);
  }

  std::uint32_t last_ring() const { return static_cast<std::uint32_t>(mesh_.vertex_count()) - (sides_ + 1); }

  void add_point(const Stop& stop, const Vec3& at, const Vec3& normal, const Vec2f& uv) {
    mesh_.positions.push_back(Vec3f(at));
    mesh_.normals.push_back(Vec3f(normal));
    mesh_.uvs.push_back(uv);
    mesh_.internodes.push_back(stop.internode);
  }

  /// Its first vertex comes once more at the end, where u is 1.
  void add_ring(const Stop& stop, const Vec3& along, const Vec3& side, float v) {
    const Vec3 across = glm::cross(along, side);
    for (std::uint32_t i = 0; i <= sides_; ++i) {
      const double turn = static_cast<double>(i) / sides_;
      const double angle = 2.0 * std::numbers::pi * (i % sides_) / sides_;
      const Vec3 outwards = side * std::cos(angle) + across * std::sin(angle);
      add_point(stop, stop.at + outwards * stop.radius, outwards, {static_cast<float>(turn), v});
    }
  }

  void join(std::uint32_t low, std::uint32_t high) {
    for (std::uint32_t i = 0; i < sides_; ++i) {
      mesh_.triangles.push_back({low + i, low + i + 1, high + i + 1});
      mesh_.triangles.push_back({low + i, high + i + 1, high + i});
    }
  }

  void close(std::uint32_t center, std::uint32_t ring, bool is_base) {
    for (std::uint32_t i = 0; i < sides_; ++i) {
      mesh_.triangles.push_back({center, ring + i + (is_base ? 1 : 0), ring + i + (is_base ? 0 : 1)});
    }
  }

  std::uint32_t sides_;
  Mesh& mesh_;
};

}  // namespace

std::size_t add_thin_tubes(const Skeleton& skeleton, const std::vector<bool>& is_tube, int sides,
                           Mesh& mesh) {
  const double thinnest = thinnest_radius(skeleton);
  std::vector<std::uint32_t> continuation(skeleton.node_count(), kNoParent);
  std::vector<std::uint32_t> founders;
  for (std::uint32_t node = 0; node < skeleton.node_count(); ++node) {
    if (skeleton.is_root(node) || !is_tube[node]) continue;
    const std::uint32_t parent = skeleton.parent[node];
    const bool goes_on =
        !skeleton.is_root(parent) && is_tube[parent] && skeleton.axis[node] == skeleton.axis[parent];
    if (goes_on) continuation[parent] = node;
    if (!goes_on) founders.push_back(node);
  }
  TubeAdder tubes(sides, mesh);
  std::size_t count = 0;
  for (const std::uint32_t founder : founders) {
    std::vector<Stop> stops = {{skeleton.position[skeleton.parent[founder]],
                                std::max(skeleton.start_radius(founder), thinnest), founder}};
    for (std::uint32_t node = founder; node != kNoParent; node = continuation[node]) {
      const double radius = std::max(0.5 * skeleton.diameter[node], thinnest);
      if (glm::length(skeleton.position[node] - stops.back().at) < 2.0 * radius) continue;
      stops.push_back({skeleton.position[node], radius, node});
    }
    if (stops.size() < 2) continue;
    tubes.add(stops);
    ++count;
  }
  return count;
}

}  // namespace ramify
