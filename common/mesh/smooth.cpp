#include "common/mesh/smooth.h"

#include <algorithm>
#include <span>

#include "common/base/parallel.h"
#include "common/mesh/wood.h"

namespace ramify {
namespace {

// Rings nearer than this, in diameters, would cut into each other where thick wood bends in short internodes;
// nodes between stay well inside the wood.
constexpr double kRingSpacing = 0.75;

// A bend's ring is widened to keep the tube's thickness, but no more than at a right angle.
constexpr double kMiterMax = std::numbers::sqrt2;

/// The nodes of one tube, base to tip, as a range of `Tubes::nodes`, and where its part of the mesh begins.
struct Tube {
  std::size_t first = 0;
  std::size_t count = 0;
  std::uint32_t sides = 0;
  bool starts_at_root = false;
  std::size_t first_vertex = 0;
  std::size_t first_triangle = 0;
};

struct Tubes {
  std::vector<std::uint32_t> nodes;
  std::vector<Tube> tubes;
};

// A ring repeats its first vertex at the end, where u jumps from 1 to 0.
std::size_t ring_vertices(const Tube& tube) {
  return tube.sides + 1;
}

// The rings, the tip and, at a root, the flat end with a rim of its own normals.
std::size_t vertex_count(const Tube& tube) {
  return tube.count * ring_vertices(tube) + tube.sides + (tube.starts_at_root ? tube.sides + 1 : 0);
}

std::size_t triangle_count(const Tube& tube) {
  return (tube.count - 1) * tube.sides * 2 + tube.sides + (tube.starts_at_root ? tube.sides : 0);
}

/// Chains the internodes of each axis, leaving out nodes that crowd. A tube begins at the node that its first
/// internode grows from.
Tubes trace_tubes(const Skeleton& skeleton) {
  const std::size_t count = skeleton.node_count();
  std::vector<std::uint32_t> continuation(count, kNoParent);
  std::vector<std::uint32_t> founders;
  for (std::size_t node = 0; node < count; ++node) {
    if (skeleton.is_root(node)) continue;
    const std::uint32_t parent = skeleton.parent[node];
    if (skeleton.axis[node] == skeleton.axis[parent]) {
      continuation[parent] = static_cast<std::uint32_t>(node);
    } else {
      founders.push_back(static_cast<std::uint32_t>(node));
    }
  }

  Tubes result;
  result.nodes.reserve(count + founders.size());
  const auto trace = [&](std::uint32_t base, std::uint32_t first, bool starts_at_root) {
    Tube tube;
    tube.first = result.nodes.size();
    tube.starts_at_root = starts_at_root;
    result.nodes.push_back(base);
    for (std::uint32_t node = first; node != kNoParent; node = continuation[node]) {
      const double apart = glm::length(skeleton.position[node] - skeleton.position[result.nodes.back()]);
      const bool is_crowded = apart < kRingSpacing * skeleton.diameter[node];
      const bool is_tip = continuation[node] == kNoParent;
      if (is_tip || !is_crowded) result.nodes.push_back(node);
    }
    tube.count = result.nodes.size() - tube.first;
    result.tubes.push_back(tube);
  };
  for (std::uint32_t root = 0; root < skeleton.root_count(); ++root) {
    if (continuation[root] != kNoParent) trace(root, continuation[root], true);
  }
  // Laterals at a root start inside the trunk's wood, like all others.
  for (const std::uint32_t founder : founders) trace(skeleton.parent[founder], founder, false);
  return result;
}

/// Writes one tube into its own part of the mesh.
class TubeBuilder {
 public:
  TubeBuilder(const Skeleton& skeleton, const Tube& tube, std::span<const std::uint32_t> nodes, Mesh& mesh)
      : skeleton_(skeleton), tube_(tube), nodes_(nodes), mesh_(mesh) {}

  void build() {
    Vec3 previous_tangent = tangent(0);
    Vec3 side = any_perpendicular(previous_tangent);
    double v = 0.0;
    for (std::size_t ring = 0; ring < nodes_.size(); ++ring) {
      const Vec3 along = tangent(ring);
      side = transported(side, previous_tangent, along);
      previous_tangent = along;
      if (ring > 0) {
        const double girth = std::numbers::pi * (radius(ring) + radius(ring - 1));
        v += glm::length(position(ring) - position(ring - 1)) / girth;
      }
      add_ring(ring, along, side, static_cast<float>(v));
      if (ring > 0) join_rings(ring);
    }
    add_tip(previous_tangent, static_cast<float>(v));
    if (tube_.starts_at_root) add_flat_end();
  }

 private:
  Vec3 position(std::size_t ring) const { return skeleton_.position[nodes_[ring]]; }

  /// A lateral is as wide at its base as at its first node, not as the parent there.
  double radius(std::size_t ring) const {
    const bool is_lateral_base = ring == 0 && !tube_.starts_at_root;
    return 0.5 * skeleton_.diameter[nodes_[is_lateral_base ? 1 : ring]];
  }

  Vec3 direction(std::size_t ring) const {  // of the internode that ends at `ring`
    return normalized_or(position(ring) - position(ring - 1), kUp, 1e-12);
  }

  /// Halfway between the internodes on both sides of a ring.
  Vec3 tangent(std::size_t ring) const {
    if (ring == 0) return direction(1);
    if (ring + 1 == nodes_.size()) return direction(ring);
    return normalized_or(direction(ring) + direction(ring + 1), direction(ring + 1));
  }

  /// How fast the tube narrows at a ring: lost radius a metre.
  double taper(std::size_t ring) const {
    const std::size_t low = ring == 0 ? 0 : ring - 1;
    const std::size_t high = std::min(ring + 1, nodes_.size() - 1);
    const double length = glm::length(position(high) - position(low));
    return length > 1e-12 ? (radius(low) - radius(high)) / length : 0.0;
  }

  void set_vertex(std::size_t vertex, std::size_t ring, const Vec3& at, const Vec3& normal, Vec2f uv) {
    mesh_.positions[vertex] = Vec3f(at);
    mesh_.normals[vertex] = glm::normalize(Vec3f(normal));
    mesh_.uvs[vertex] = uv;
    // The base ring shows the same internode as the one above it.
    mesh_.internodes[vertex] = nodes_[std::max<std::size_t>(ring, 1)];
  }

  /// What to add to a ring's offset `outwards` so that a tube keeps its thickness round a bend: the ring is
  /// stretched, in the plane of the bend, by 1 / cos of half the turn.
  Vec3 mitered(std::size_t ring, const Vec3& outwards) const {
    if (ring == 0 || ring + 1 == nodes_.size()) return outwards;
    const Vec3 bend = direction(ring) - direction(ring + 1);
    const double half_sine = 0.5 * glm::length(bend);
    if (half_sine < 1e-6) return outwards;
    const double cosine = std::sqrt(std::max(0.0, 1.0 - half_sine * half_sine));
    const double stretch = std::min(1.0 / std::max(cosine, 1e-6), kMiterMax) - 1.0;
    const Vec3 axis = bend / (2.0 * half_sine);
    return outwards + axis * (stretch * glm::dot(outwards, axis));
  }

  void add_ring(std::size_t ring, const Vec3& along, const Vec3& side, float v) {
    const Vec3 across = glm::cross(along, side);
    const double r = radius(ring);
    const double slope = taper(ring);
    const std::size_t first = ring_start(ring);
    for (std::uint32_t i = 0; i <= tube_.sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i % tube_.sides) / tube_.sides;
      const Vec3 outwards = side * std::cos(angle) + across * std::sin(angle);
      set_vertex(first + i, ring, position(ring) + mitered(ring, outwards) * r, outwards + along * slope,
                 {static_cast<float>(i) / static_cast<float>(tube_.sides), v});
    }
  }

  void join_rings(std::size_t ring) {
    std::size_t triangle = tube_.first_triangle + (ring - 1) * tube_.sides * 2;
    for (std::uint32_t i = 0; i < tube_.sides; ++i) {
      const auto low = static_cast<std::uint32_t>(ring_start(ring - 1) + i);
      const auto high = static_cast<std::uint32_t>(ring_start(ring) + i);
      mesh_.triangles[triangle++] = {low, low + 1, high + 1};
      mesh_.triangles[triangle++] = {low, high + 1, high};
    }
  }

  /// A cone as long as it is wide. Its point has a vertex for each side, so that shading runs round it.
  void add_tip(const Vec3& along, float v) {
    const std::size_t last = nodes_.size() - 1;
    const std::size_t ring = ring_start(last);
    const std::size_t points = ring_start(nodes_.size());
    const Vec3 apex = position(last) + along * (2.0 * radius(last));
    std::size_t triangle = tube_.first_triangle + last * tube_.sides * 2;
    for (std::uint32_t i = 0; i < tube_.sides; ++i) {
      const Vec3 between = Vec3(mesh_.normals[ring + i]) + Vec3(mesh_.normals[ring + i + 1]);
      set_vertex(points + i, last, apex, normalized_or(between, along) + along,
                 {(static_cast<float>(i) + 0.5f) / static_cast<float>(tube_.sides), v + 0.3f});
      const auto low = static_cast<std::uint32_t>(ring + i);
      mesh_.triangles[triangle++] = {low, low + 1, static_cast<std::uint32_t>(points + i)};
    }
  }

  /// Closes a root's end with a fan that faces down the trunk.
  void add_flat_end() {
    const std::size_t center = ring_start(nodes_.size()) + tube_.sides;
    const std::size_t ring = ring_start(0);
    const Vec3 down = -tangent(0);
    set_vertex(center, 0, position(0), down, {0.5f, 0.0f});
    std::size_t triangle = tube_.first_triangle + (nodes_.size() - 1) * tube_.sides * 2 + tube_.sides;
    for (std::uint32_t i = 0; i < tube_.sides; ++i) {
      const std::size_t rim = center + 1 + i;
      set_vertex(rim, 0, Vec3(mesh_.positions[ring + i]), down, mesh_.uvs[ring + i]);
      const auto next = static_cast<std::uint32_t>(center + 1 + (i + 1) % tube_.sides);
      mesh_.triangles[triangle++] = {static_cast<std::uint32_t>(center), next,
                                     static_cast<std::uint32_t>(rim)};
    }
  }

  std::size_t ring_start(std::size_t ring) const { return tube_.first_vertex + ring * ring_vertices(tube_); }

  const Skeleton& skeleton_;
  const Tube& tube_;
  std::span<const std::uint32_t> nodes_;
  Mesh& mesh_;
};

}  // namespace

Mesh smooth_mesh(const Skeleton& skeleton, const MesherOptions& options) {
  Tubes tubes = trace_tubes(skeleton);
  const double greatest = *std::max_element(skeleton.diameter.begin(), skeleton.diameter.end());
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  for (Tube& tube : tubes.tubes) {
    tube.sides = side_count(skeleton.diameter[tubes.nodes[tube.first + 1]], greatest, options);
    tube.first_vertex = vertices;
    tube.first_triangle = triangles;
    vertices += vertex_count(tube);
    triangles += triangle_count(tube);
  }

  Mesh mesh = wood_of_size(vertices, triangles);
  parallel_for(tubes.tubes.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Tube& tube = tubes.tubes[i];
      TubeBuilder(skeleton, tube, std::span(tubes.nodes).subspan(tube.first, tube.count), mesh).build();
    }
  });
  return mesh;
}

}  // namespace ramify
