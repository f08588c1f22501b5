// Least-cost paths from one node to all others.
// E. W. Dijkstra, A note on two problems in connexion with graphs, Numerische Mathematik 1, 1959; with the
// buckets of R. B. Dial, Algorithm 360, Communications of the ACM 12(11), 1969.
#pragma once

#include <cstdint>
#include <limits>
#include <stop_token>
#include <vector>

#include "pathplan/graph.h"

namespace ramify::pathplan {

inline constexpr double kUnreached = std::numeric_limits<double>::infinity();

struct ShortestPaths {
  std::vector<double> cost;           // from the source, by node; kUnreached where no path leads
  std::vector<std::uint32_t> parent;  // the node before it on its path; kNoParent of the source

  bool is_reached(std::uint32_t node) const { return cost[node] != kUnreached; }
};

/// Weights must be more than 0. The costs are the least there are: sums of weights from the source on, in
/// double precision; a node's is more than its parent's. About O(edges). A stop request leaves costs that are
/// too great.
ShortestPaths shortest_paths(const Graph& graph, std::uint32_t source, std::stop_token stop = {});

}  // namespace ramify::pathplan
