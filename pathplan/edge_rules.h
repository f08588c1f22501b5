// Which two nodes an edge may join.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/geometry.h"
#include "pathplan/domain.h"

namespace ramify::pathplan {

/// Asked while a graph's edges are searched, so that a nearest node is the nearest that is allowed. Any
/// number of threads may ask.
class EdgeRules {
 public:
  /// Edges are at most `max_length` metres long, inside the domain and, where nodes have subvolumes (one
  /// entry a node, 0 is the trunk), within one subvolume or to the trunk. O(nodes).
  /// All that is given is looked at later: it must outlive the rules.
  EdgeRules(const Domain& domain, std::span<const Vec3> nodes, double max_length,
            std::span<const std::uint32_t> subvolumes = {});

  double max_length() const { return max_length_; }

  /// Whether the subvolumes may be joined, the segment is inside the solid, looked at in three places (at
  /// 1/4, 1/2 and 3/4), and no obstacle is in its way.
  bool allows(std::uint32_t a, std::uint32_t b) const {
    return may_join(a, b) && is_inside(a, b) && domain_.is_free(nodes_[a], nodes_[b]);
  }

 private:
  static constexpr std::uint32_t kNoPart = 0xffffffff;

  bool may_join(std::uint32_t a, std::uint32_t b) const {
    return subvolumes_.empty() || subvolumes_[a] == subvolumes_[b] || subvolumes_[a] == 0 ||
           subvolumes_[b] == 0;
  }
  bool is_inside(std::uint32_t a, std::uint32_t b) const {
    return is_convex_ || (part_[a] == part_[b] && part_[a] != kNoPart) ||
           segment_is_inside(nodes_[a], nodes_[b]);
  }
  bool segment_is_inside(const Vec3& a, const Vec3& b) const;

  const Domain& domain_;
  std::span<const Vec3> nodes_;
  double max_length_;
  std::span<const std::uint32_t> subvolumes_;
  bool is_convex_;
  std::vector<std::uint32_t> part_;  // of each node, a convex part of the volume: it settles most questions
};

}  // namespace ramify::pathplan
