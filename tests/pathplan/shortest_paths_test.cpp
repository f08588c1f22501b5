#include "pathplan/shortest_paths.h"

#include <queue>

#include "pathplan/threshold_graph.h"
#include "tests/catch.h"
#include "tests/pathplan/graphs.h"

using namespace ramify;
using namespace ramify::pathplan;
using namespace ramify::test;

namespace {

/// Dijkstra with a binary heap, from the list of edges alone.
std::vector<double> costs_by_heap(const Graph& graph) {
  std::vector<std::vector<std::pair<std::uint32_t, double>>> links(graph.nodes.size());
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto& [a, b] = graph.edges[i];
    links[a].emplace_back(b, graph.weights[i]);
    links[b].emplace_back(a, graph.weights[i]);
  }
  std::vector<double> cost(graph.nodes.size(), kUnreached);
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  open.emplace(cost[0] = 0.0, 0);
  while (!open.empty()) {
    const auto [reached, node] = open.top();
    open.pop();
    if (reached > cost[node]) continue;
    for (const auto& [other, weight] : links[node]) {
      if (reached + weight < cost[other]) open.emplace(cost[other] = reached + weight, other);
    }
  }
  return cost;
}

}  // namespace

TEST_CASE("paths: the cheaper of two ways is taken, and what no way leads to stays unreached") {
  const Graph graph =
      graph_of(std::vector<Vec3>(5, Vec3(0.0)), {{0, 1}, {1, 2}, {0, 2}, {3, 4}}, {1.0f, 1.5f, 3.0f, 1.0f});
  const ShortestPaths paths = shortest_paths(graph, kRoot);
  CHECK(paths.cost == std::vector<double>{0.0, 1.0, 2.5, kUnreached, kUnreached});
  CHECK(paths.parent == std::vector<std::uint32_t>{kNoParent, 0, 1, kNoParent, kNoParent});
  CHECK(paths.is_reached(2));
  CHECK_FALSE(paths.is_reached(3));
  CHECK(component_count(graph) == 2);
}

TEST_CASE("paths: a node without edges reaches itself") {
  const ShortestPaths paths = shortest_paths(graph_of({Vec3(0.0)}, {}, {}), kRoot);
  CHECK(paths.cost == std::vector<double>{0.0});
}

TEST_CASE("paths: costs are those of an independent search, whatever the weights") {
  const std::vector<RandomWeights> kinds = {{.seed = 1},
                                            {.low = 0.001, .high = 1000.0, .seed = 2},
                                            {.exponent = 8.0, .low = 0.001, .high = 1000.0, .seed = 3},
                                            {.exponent = 0.0, .low = 1.0, .high = 1.0, .seed = 4}};
  for (const Place& place : places()) {
    for (const RandomWeights& weights : kinds) {
      INFO(place.name << ", seed " << weights.seed);
      const Graph graph = graph_in(place, 3000, weights);
      const ShortestPaths paths = shortest_paths(graph, kRoot);
      CHECK(paths.cost == costs_by_heap(graph));
      // Each node's cost is its parent's and one edge more.
      for (std::uint32_t node = 1; node < graph.nodes.size(); ++node) {
        if (!paths.is_reached(node)) continue;
        double best = kUnreached;
        for (const Link& link : graph.links_of(node)) {
          if (link.node == paths.parent[node]) best = paths.cost[link.node] + link.weight;
        }
        REQUIRE(paths.cost[node] == best);
        REQUIRE(paths.cost[node] > paths.cost[paths.parent[node]]);
      }
    }
  }
}

TEST_CASE("paths: weights that differ by many powers of ten make no search slow") {
  // A few very long edges on the hull are heavier than all others by far; or light ones are rare, or all in
  // one place.
  const Place place = places()[0];
  const Nodes nodes = scatter_nodes(place.volume, place.root, {.nodes = 12'000});
  const OpenDomain open(place.volume);
  for (const double max_edge : {6.0, 100.0}) {
    const EdgeRules rules(open.domain, nodes.position, max_edge * nodes.spacing);
    Graph graph;
    graph.nodes = nodes.position;
    graph.edges = max_edge > 10.0 ? yao_edges(nodes.position, rules, 8, nodes.spacing)
                                  : threshold_edges(nodes.position, rules);
    assign_random_weights(graph, {.exponent = 8.0, .low = 0.2, .high = 1.0});
    link_nodes(graph);
    CHECK(shortest_paths(graph, kRoot).cost == costs_by_heap(graph));
  }
  Graph graph = graph_in(place, 12'000, {});
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    if (glm::length(graph.nodes[graph.edges[i][0]]) < 1.2) graph.weights[i] *= 0.001f;
  }
  link_nodes(graph);
  CHECK(shortest_paths(graph, kRoot).cost == costs_by_heap(graph));
}

TEST_CASE(
    "paths: a node costs more than its parent even where its edge weighs nothing beside the way there") {
  const Graph graph =
      graph_of(std::vector<Vec3>(4, Vec3(0.0)), {{0, 3}, {3, 2}, {2, 1}}, {1e20f, 1.0f, 1.0f});
  const ShortestPaths paths = shortest_paths(graph, kRoot);
  CHECK(paths.cost[3] < paths.cost[2]);
  CHECK(paths.cost[2] < paths.cost[1]);
}

TEST_CASE("graph: each edge is linked at both its ends") {
  const Graph graph = graph_in(places()[1], 1000, {});
  CHECK(graph.links.size() == 2 * graph.edges.size());
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    for (const auto& [from, to] :
         {std::pair(graph.edges[i][0], graph.edges[i][1]), std::pair(graph.edges[i][1], graph.edges[i][0])}) {
      int found = 0;
      for (const Link& link : graph.links_of(from)) {
        if (link.node == to && link.weight == graph.weights[i]) ++found;
      }
      REQUIRE(found == 1);
    }
  }
  CHECK(component_count(graph) == 1);
}
