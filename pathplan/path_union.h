// The union of the least-cost paths of one graph: a tree, whatever the number of searches.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012, Fig.
// 4, step 3.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pathplan/shortest_paths.h"

namespace ramify::pathplan {

class PathUnion {
 public:
  /// Of a graph with so many nodes; at first it holds node 0, the root, alone.
  explicit PathUnion(std::size_t graph_nodes);

  /// Adds the paths from endpoints, which must be reached, to the nearest node that is in it. `paths` were
  /// searched from nodes that are in it. O(n log n) in the nodes that are new.
  void add(const ShortestPaths& paths, std::span<const std::uint32_t> endpoints);

  bool contains(std::uint32_t node) const { return place_[node] != kNoPlace; }

  /// The nodes of the graph that are in it, parents first; the root is the first.
  const std::vector<std::uint32_t>& nodes() const { return nodes_; }
  /// For each of these the place of its parent among them; kNoParent for the root.
  const std::vector<std::uint32_t>& parents() const { return parents_; }
  /// The place of a node of the graph that is in it.
  std::uint32_t place(std::uint32_t node) const { return place_[node]; }

 private:
  static constexpr std::uint32_t kNoPlace = 0xffffffff;

  std::vector<std::uint32_t> nodes_;
  std::vector<std::uint32_t> parents_;
  std::vector<std::uint32_t> place_;  // by node of the graph
};

}  // namespace ramify::pathplan
