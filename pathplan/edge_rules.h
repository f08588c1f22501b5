// Which two nodes an edge may join.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/geometry.h"
#include "common/volume/volume.h"

namespace ramify::pathplan {

/// Asked while a graph's edges are searched, so that a nearest node is the nearest that is allowed. Any
/// number of threads may ask.
class EdgeRules {
 public:
  /// Edges are at most `max_length` metres long and inside `volume`. O(nodes).
  /// `nodes` are looked at later: they must outlive the rules.
  EdgeRules(const Volume& volume, std::span<const Vec3> nodes, double max_length);

  double max_length() const { return max_length_; }

  /// Whether the segment between two nodes is inside the volume, looked at in three places: at 1/4, 1/2
  /// and 3/4.
  bool allows(std::uint32_t a, std::uint32_t b) const {
    return (part_[a] == part_[b] && part_[a] != kNoPart) || segment_is_inside(nodes_[a], nodes_[b]);
  }

 private:
  static constexpr std::uint32_t kNoPart = 0xffffffff;

  bool segment_is_inside(const Vec3& a, const Vec3& b) const;

  Solid solid_;
  std::span<const Vec3> nodes_;
  double max_length_;
  std::vector<std::uint32_t> part_;  // of each node, a convex part of the volume: it settles most questions
};

}  // namespace ramify::pathplan
