// Planning paths with what libraries offer: nearest neighbours from nanoflann's kd-tree, graph and Dijkstra
// from Boost.Graph.
#pragma once

#include <span>
#include <vector>

#include "pathplan/graph.h"
#include "pathplan/weights.h"

namespace ramify::bench {

// So many give about as many edges as the Yao graph of 8 sectors has.
inline constexpr int kNeighbours = 9;

struct PlainPaths {
  std::vector<double> cost;  // from node 0, by node; infinite where no path leads
  std::size_t edges = 0;     // of the graph
};

/// Each node is joined to its kNeighbours nearest ones. O(n log n).
PlainPaths plain_paths(std::span<const Vec3> nodes, const pathplan::RandomWeights& weights);

/// Boost's Dijkstra on the edges of a graph of ours.
PlainPaths plain_paths(const pathplan::Graph& graph);

}  // namespace ramify::bench
