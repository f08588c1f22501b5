#include "pathplan/graph.h"

#include <algorithm>
#include <numeric>

namespace ramify::pathplan {

void link_nodes(Graph& graph) {
  graph.first.assign(graph.nodes.size() + 1, 0);
  for (const auto& [a, b] : graph.edges) {
    ++graph.first[a];
    ++graph.first[b];
  }
  std::partial_sum(graph.first.begin(), graph.first.end(), graph.first.begin());

  // From the last edge to the first: `first` comes down from the ends of the nodes' links to their
  // beginnings.
  graph.links.resize(2 * graph.edges.size());
  for (std::size_t i = graph.edges.size(); i-- > 0;) {
    const auto [a, b] = graph.edges[i];
    graph.links[--graph.first[a]] = {b, graph.weights[i]};
    graph.links[--graph.first[b]] = {a, graph.weights[i]};
  }
}

std::size_t most_links(const Graph& graph) {
  std::size_t most = 0;
  for (std::size_t node = 0; node + 1 < graph.first.size(); ++node) {
    most = std::max(most, std::size_t{graph.first[node + 1] - graph.first[node]});
  }
  return most;
}

double mean_edge_length(const Graph& graph) {
  double sum = 0.0;
  for (const auto& [a, b] : graph.edges) sum += glm::distance(graph.nodes[a], graph.nodes[b]);
  return graph.edges.empty() ? 0.0 : sum / static_cast<double>(graph.edges.size());
}

std::size_t component_count(const Graph& graph) {
  std::vector<bool> is_seen(graph.nodes.size(), false);
  std::vector<std::uint32_t> open;
  std::size_t components = 0;
  for (std::uint32_t start = 0; start < graph.nodes.size(); ++start) {
    if (is_seen[start]) continue;
    ++components;
    is_seen[start] = true;
    open.push_back(start);
    while (!open.empty()) {
      const std::uint32_t node = open.back();
      open.pop_back();
      for (const Link& link : graph.links_of(node)) {
        if (is_seen[link.node]) continue;
        is_seen[link.node] = true;
        open.push_back(link.node);
      }
    }
  }
  return components;
}

}  // namespace ramify::pathplan
