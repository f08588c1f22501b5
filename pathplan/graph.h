// The graph that paths are planned in: nodes, weighted undirected edges and, for each node, its links.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/geometry.h"

namespace ramify::pathplan {

/// Two nodes by their numbers.
using Edge = std::array<std::uint32_t, 2>;

/// One end's view of an edge.
struct Link {
  std::uint32_t node;  // at the other end
  float weight;
};

/// The links of node i are links[first[i]] to links[first[i + 1] - 1].
struct Graph {
  std::vector<Vec3> nodes;     // metres; the root is node 0
  std::vector<Edge> edges;     // each once
  std::vector<float> weights;  // one an edge, more than 0
  std::vector<std::uint32_t> first;
  std::vector<Link> links;

  std::span<const Link> links_of(std::uint32_t node) const {
    return std::span(links).subspan(first[node], first[node + 1] - first[node]);
  }
};

/// Nodes are taken from all over a large graph: their links had better be on their way from memory. Those of
/// `soon` are asked for, and where those of `later` are.
inline void prefetch_links(const Graph& graph, std::uint32_t soon, std::uint32_t later) {
  constexpr std::size_t kLinksALine = 64 / sizeof(Link);
  const Link* const links = graph.links.data() + graph.first[soon];
  __builtin_prefetch(links);
  __builtin_prefetch(links + kLinksALine);
  __builtin_prefetch(graph.first.data() + later);
}

/// Sets `first` and `links` from the edges and their weights. O(edges).
void link_nodes(Graph& graph);

/// Of the node that has most. O(nodes).
std::size_t most_links(const Graph& graph);

/// Metres; 0 without edges. O(edges).
double mean_edge_length(const Graph& graph);

/// Sets of nodes that edges connect. O(nodes + edges).
std::size_t component_count(const Graph& graph);

}  // namespace ramify::pathplan
