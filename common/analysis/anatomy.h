// What the nodes of a skeleton are to each other, worked out once for all measures.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/skeleton/skeleton.h"

namespace ramify {

/// Children, axes and tips of a skeleton, which must outlive it. An axis is a maximal chain of internodes
/// that have one axis name; the internode that starts at a root, or at a node of another axis, founds it.
class Anatomy {
 public:
  /// O(n). The skeleton must be sound (violations()).
  explicit Anatomy(const Skeleton& skeleton);

  const Skeleton& skeleton() const { return skeleton_; }

  /// In ascending order.
  std::span<const std::uint32_t> children(std::size_t node) const { return child_.at(node); }

  std::size_t axis_count() const { return axis_.first.size() - 1; }
  /// The internodes of an axis from its base to its tip; never empty. Axes are in the order of their
  /// founders.
  std::span<const std::uint32_t> axis(std::size_t index) const { return axis_.at(index); }
  /// The axis of an internode.
  std::size_t axis_of(std::size_t node) const { return axis_of_[node]; }
  std::uint16_t axis_order(std::size_t index) const { return skeleton_.order[axis(index).front()]; }
  /// The internode that an axis stands on, or kNoParent for one that starts at a root.
  std::uint32_t bearer(std::size_t index) const;

  /// Internodes without children.
  const std::vector<std::uint32_t>& tips() const { return tips_; }

  /// From the root along the skeleton, metres; one a node.
  const std::vector<double>& path_lengths() const { return path_lengths_; }

  /// Root node below each node.
  const std::vector<std::uint32_t>& root_of() const { return root_of_; }

  bool is_founder(std::size_t node) const { return axis(axis_of_[node]).front() == node; }

 private:
  /// Lists of nodes, one behind the other.
  struct Lists {
    std::vector<std::uint32_t> first;  // of each list; one more at the end
    std::vector<std::uint32_t> nodes;
    std::span<const std::uint32_t> at(std::size_t list) const {
      return std::span(nodes).subspan(first[list], first[list + 1] - first[list]);
    }
  };
  /// The nodes from `begin` on, sorted by their key (below `lists`) and then by themselves.
  static Lists grouped(std::span<const std::uint32_t> key, std::size_t begin, std::size_t lists);

  const Skeleton& skeleton_;
  Lists child_;
  Lists axis_;
  std::vector<std::uint32_t> axis_of_;
  std::vector<std::uint32_t> tips_;
  std::vector<double> path_lengths_;
  std::vector<std::uint32_t> root_of_;
};

}  // namespace ramify
