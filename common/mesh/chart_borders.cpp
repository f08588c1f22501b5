#include "common/mesh/chart_borders.h"

#include <algorithm>
#include <compare>

#include "common/mesh/wood_field.h"

namespace ramify {
namespace {

// A cut stays so far from an edge's ends, in parts of the edge: no triangle gets too thin.
constexpr double kFromEnds = 0.1;

// Cosine of the greatest angle between a vertex's normal and its triangles'.
constexpr float kFacing = 0.5f;

/// An edge between two axes, its lower vertex first.
struct CutEdge {
  std::uint32_t low;
  std::uint32_t high;
  friend auto operator<=>(const CutEdge&, const CutEdge&) = default;
};

/// An axis to which a vertex may go.
struct Offer {
  std::uint32_t vertex;
  double distance;  // from that axis, metres
  std::uint32_t internode;
  friend auto operator<=>(const Offer&, const Offer&) = default;
};

class Cutter {
 public:
  Cutter(const Skeleton& skeleton, Mesh& mesh)
      : skeleton_(skeleton), mesh_(mesh), next_(skeleton.node_count(), kNoParent) {
    for (std::uint32_t node = 0; node < next_.size(); ++node) {
      if (!skeleton.is_root(node) && is_same_axis(node, skeleton.parent[node]))
        next_[skeleton.parent[node]] = node;
    }
  }

  std::vector<std::uint32_t> cut() {
    give_up_specks();
    find_edges();
    add_vertices();
    std::vector<std::uint32_t> internodes(mesh_.triangles.size());
    const std::size_t count = mesh_.triangles.size();
    for (std::size_t t = 0; t < count; ++t) {
      internodes[t] = mesh_.internodes[mesh_.triangles[t][0]];
      if (is_mixed(mesh_.triangles[t])) cut_triangle(t, internodes);
    }
    mend_normals();
    return internodes;
  }

 private:
  bool is_same_axis(std::uint32_t a, std::uint32_t b) const { return skeleton_.axis[a] == skeleton_.axis[b]; }

  bool is_between(std::uint32_t a, std::uint32_t b) const {
    return !is_same_axis(mesh_.internodes[a], mesh_.internodes[b]);
  }

  bool is_mixed(const Triangle& triangle) const {
    return is_between(triangle[0], triangle[1]) || is_between(triangle[1], triangle[2]);
  }

  /// Wood of an axis that shows in single vertices, as where it is hardly wider than a triangle between two
  /// others, would make saws of their borders. Those vertices go to the axis next to them that is nearest.
  void give_up_specks() {
    std::vector<bool> is_speck(mesh_.vertex_count(), true);  // no triangle lies wholly on its axis
    for (const Triangle& triangle : mesh_.triangles) {
      if (is_mixed(triangle)) continue;
      for (const std::uint32_t v : triangle) is_speck[v] = false;
    }
    std::vector<Offer> offers;
    for (const Triangle& triangle : mesh_.triangles) {
      for (const std::uint32_t v : triangle) {
        if (!is_speck[v]) continue;
        for (const std::uint32_t other : triangle) {
          const std::uint32_t internode = mesh_.internodes[other];
          if (is_between(v, other))
            offers.push_back({v, distance(Vec3(mesh_.positions[v]), internode), internode});
        }
      }
    }
    std::sort(offers.begin(), offers.end());
    for (std::size_t i = 0; i < offers.size(); ++i) {
      if (i == 0 || offers[i].vertex != offers[i - 1].vertex)
        mesh_.internodes[offers[i].vertex] = offers[i].internode;
    }
  }

  void find_edges() {
    for (const Triangle& triangle : mesh_.triangles) {
      if (!is_mixed(triangle)) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = triangle[i];
        const std::uint32_t b = triangle[(i + 1) % 3];
        // Each edge has two triangles, which go along it in opposite directions.
        if (a < b && is_between(a, b)) edges_.push_back({a, b});
      }
    }
    std::sort(edges_.begin(), edges_.end());
  }

  void add_vertices() {
    first_ = static_cast<std::uint32_t>(mesh_.vertex_count());
    for (const auto& [low, high] : edges_) {
      const double to_low = lead(low, high);
      const double to_high = -lead(high, low);
      const double share = to_low < to_high ? to_low / (to_low - to_high) : 0.5;
      const auto t = static_cast<float>(std::clamp(share, kFromEnds, 1.0 - kFromEnds));
      const Vec3f position = glm::mix(mesh_.positions[low], mesh_.positions[high], t);
      const Vec3f normal =
          normalized_or(glm::mix(mesh_.normals[low], mesh_.normals[high], t), mesh_.normals[low]);
      const std::uint32_t internode = mesh_.internodes[low];
      mesh_.positions.push_back(position);
      mesh_.normals.push_back(normal);
      mesh_.internodes.push_back(internode);
    }
  }

  /// How much farther a vertex is from its own axis than from the other's: negative, or little more.
  double lead(std::uint32_t vertex, std::uint32_t other) const {
    const Vec3 at(mesh_.positions[vertex]);
    return distance(at, mesh_.internodes[vertex]) - distance(at, mesh_.internodes[other]);
  }

  /// From the wood of an axis about one of its internodes.
  double distance(const Vec3& point, std::uint32_t internode) const {
    double least = distance_to(point, internode);
    const std::uint32_t before = skeleton_.parent[internode];
    if (!skeleton_.is_root(before) && is_same_axis(before, internode))
      least = std::min(least, distance_to(point, before));
    if (next_[internode] != kNoParent) least = std::min(least, distance_to(point, next_[internode]));
    return least;
  }

  double distance_to(const Vec3& point, std::uint32_t internode) const {
    return round_cone(skeleton_.position[skeleton_.parent[internode]], skeleton_.start_radius(internode),
                      skeleton_.position[internode], 0.5 * skeleton_.diameter[internode])
        .distance(point);
  }

  /// The vertex between two corners.
  std::uint32_t between(std::uint32_t a, std::uint32_t b) const {
    const CutEdge edge{std::min(a, b), std::max(a, b)};
    const auto found = std::lower_bound(edges_.begin(), edges_.end(), edge);
    return first_ + static_cast<std::uint32_t>(found - edges_.begin());
  }

  void cut_triangle(std::size_t t, std::vector<std::uint32_t>& internodes) {
    const Triangle whole = mesh_.triangles[t];
    const auto add = [&](const Triangle& part, std::uint32_t corner) {
      mesh_.triangles.push_back(part);
      internodes.push_back(mesh_.internodes[corner]);
    };
    const auto shares = [&](std::size_t i) { return !is_between(whole[i], whole[(i + 1) % 3]); };
    const std::size_t i = shares(1) ? 0 : shares(2) ? 1 : 2;  // two others may share an axis, not this one
    const auto [a, b, c] = Triangle{whole[i], whole[(i + 1) % 3], whole[(i + 2) % 3]};
    const std::uint32_t ab = between(a, b);
    const std::uint32_t ca = between(c, a);
    mesh_.triangles[t] = {a, ab, ca};
    internodes[t] = mesh_.internodes[a];
    if (!is_between(b, c)) {
      add({ab, b, c}, b);
      add({ab, c, ca}, b);
      return;
    }
    const std::uint32_t bc = between(b, c);
    add({b, bc, ab}, b);
    add({c, ca, bc}, c);
    add({ab, bc, ca}, a);
  }

  /// Where axes meet in a crease the mean of two normals may be far from what faces outwards.
  void mend_normals() {
    std::vector<bool> is_at_border(mesh_.vertex_count(), false);
    std::fill(is_at_border.begin() + first_, is_at_border.end(), true);
    for (const auto& [low, high] : edges_) is_at_border[low] = is_at_border[high] = true;
    BulkVector<Vec3f> sums(mesh_.vertex_count(), Vec3f(0.0f));
    for (const Triangle& triangle : mesh_.triangles) {
      const Vec3f a = mesh_.positions[triangle[0]];
      const Vec3f outwards = glm::cross(mesh_.positions[triangle[1]] - a, mesh_.positions[triangle[2]] - a);
      for (const std::uint32_t v : triangle) {
        if (is_at_border[v]) sums[v] += outwards;
      }
    }
    for (std::size_t v = 0; v < sums.size(); ++v) {
      const float length = glm::length(sums[v]);
      if (length > 0.0f && glm::dot(mesh_.normals[v], sums[v]) < kFacing * length)
        mesh_.normals[v] = sums[v] / length;
    }
  }

  const Skeleton& skeleton_;
  Mesh& mesh_;
  std::vector<std::uint32_t> next_;  // of each node, the one that goes on along its axis
  std::vector<CutEdge> edges_;       // in ascending order; each has a vertex
  std::uint32_t first_ = 0;          // of those vertices
};

}  // namespace

std::vector<std::uint32_t> cut_between_axes(const Skeleton& skeleton, Mesh& mesh) {
  return Cutter(skeleton, mesh).cut();
}

}  // namespace ramify
