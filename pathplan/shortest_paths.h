// Least-cost paths from some nodes to all others.
// E. W. Dijkstra, A note on two problems in connexion with graphs, Numerische Mathematik 1, 1959.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <stop_token>
#include <vector>

#include "pathplan/graph.h"

namespace ramify::pathplan {

inline constexpr double kUnreached = std::numeric_limits<double>::infinity();

struct ShortestPaths {
  std::vector<double> cost;           // from the nearest source, by node; kUnreached where no path leads
  std::vector<std::uint32_t> parent;  // the node before it on its path; kNoParent of a source

  bool is_reached(std::uint32_t node) const { return cost[node] != kUnreached; }
};

/// Paths as they are before a search: the sources cost nothing, the others are not reached.
ShortestPaths unsearched_paths(std::size_t nodes, std::span<const std::uint32_t> sources);

/// Weights must be more than 0. The costs are the least there are: sums of weights from a source on, in
/// double precision; a node's is more than its parent's. About O(edges). A stop request leaves costs that are
/// too great.
ShortestPaths shortest_paths(const Graph& graph, std::span<const std::uint32_t> sources,
                             std::stop_token stop = {});

}  // namespace ramify::pathplan
