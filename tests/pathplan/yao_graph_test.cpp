#include "pathplan/yao_graph.h"

#include <algorithm>
#include <set>

#include "common/base/parallel.h"
#include "common/base/rng.h"
#include "pathplan/poisson_disc.h"
#include "pathplan/weights.h"
#include "tests/catch.h"
#include "tests/pathplan/volumes.h"

using namespace ramify;
using namespace ramify::pathplan;
using namespace ramify::test;

namespace {

int sector_of(const Vec3& d, int sectors) {
  if (sectors == 8) return (d.x < 0 ? 1 : 0) + (d.y < 0 ? 2 : 0) + (d.z < 0 ? 4 : 0);
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(d[i]) > std::abs(d[axis])) axis = i;
  }
  return 2 * axis + (d[axis] < 0 ? 1 : 0);
}

/// The definition, every pair looked at.
std::set<Edge> edges_by_hand(const std::vector<Vec3>& nodes, const Volume& volume, double max_length,
                             int sectors) {
  const Solid solid(volume);
  std::set<Edge> edges;
  for (std::uint32_t u = 0; u < nodes.size(); ++u) {
    std::vector<std::pair<double, std::uint32_t>> best(static_cast<std::size_t>(sectors), {1e300, 0});
    for (std::uint32_t v = 0; v < nodes.size(); ++v) {
      const Vec3 d = nodes[v] - nodes[u];
      const double square = glm::dot(d, d);
      if (u == v || square > max_length * max_length) continue;
      if (!solid.contains(nodes[u] + 0.25 * d) || !solid.contains(nodes[u] + 0.5 * d) ||
          !solid.contains(nodes[u] + 0.75 * d)) {
        continue;
      }
      auto& nearest = best[static_cast<std::size_t>(sector_of(d, sectors))];
      nearest = std::min(nearest, {square, v});
    }
    for (const auto& [square, v] : best) {
      if (square < 1e300) edges.insert({std::min(u, v), std::max(u, v)});
    }
  }
  return edges;
}

std::set<Edge> as_set(const std::vector<Edge>& edges) {
  std::set<Edge> set;
  for (const auto& [a, b] : edges) set.insert({std::min(a, b), std::max(a, b)});
  return set;
}

}  // namespace

TEST_CASE("Yao graph: each node is joined to the nearest allowed node of each sector, as every pair shows") {
  for (const Place& place : places()) {
    for (const std::uint64_t seed : {1, 2}) {
      const Nodes nodes = scatter_nodes(place.volume, place.root, {.nodes = 350}, seed);
      for (const int sectors : {6, 8}) {
        for (const double max_edge : {1.2, 3.0, 30.0}) {
          INFO(place.name << ", seed " << seed << ", " << sectors << " sectors, max_edge " << max_edge);
          const double max_length = max_edge * nodes.spacing;
          const OpenDomain open(place.volume);
          const EdgeRules rules(open.domain, nodes.position, max_length);
          const std::vector<Edge> edges = yao_edges(nodes.position, rules, sectors, nodes.spacing);
          CHECK(as_set(edges).size() == edges.size());  // each once
          CHECK(as_set(edges) == edges_by_hand(nodes.position, place.volume, max_length, sectors));
        }
      }
    }
  }
}

TEST_CASE("Yao graph: equal distances go to the lower number, in whatever order the nodes are numbered") {
  const Volume room{.shape = Shape::sphere, .radius = 100.0};
  std::vector<Vec3> nodes;
  for (int x = 0; x < 6; ++x) {
    for (int y = 0; y < 6; ++y) {
      for (int z = 0; z < 6; ++z) nodes.emplace_back(x, y, z);
    }
  }
  for (const std::uint64_t seed : {1, 2, 3}) {
    Rng rng = Rng::stream(seed, Stream::dart, 0);
    for (std::size_t i = nodes.size(); i > 1; --i) std::swap(nodes[i - 1], nodes[rng.below(i)]);
    for (const int sectors : {6, 8}) {
      const OpenDomain open(room);
      const EdgeRules rules(open.domain, nodes, 3.0);
      CHECK(as_set(yao_edges(nodes, rules, sectors, 1.0)) == edges_by_hand(nodes, room, 3.0, sectors));
    }
  }
}

TEST_CASE("Yao graph: an edge may be exactly as long as is allowed") {
  const Volume room{.shape = Shape::sphere, .radius = 100.0};
  const std::vector<Vec3> nodes = {{0, 0, 0}, {3, 0, 0}, {0, 3.1, 0}};
  const OpenDomain open(room);
  const EdgeRules rules(open.domain, nodes, 3.0);
  CHECK(as_set(yao_edges(nodes, rules, 8, 1.0)) == std::set<Edge>{{0, 1}});
}

TEST_CASE("Yao graph: it is the same for any number of threads") {
  const Place place = places()[1];
  const Nodes nodes = scatter_nodes(place.volume, place.root, {.nodes = 5000});
  const auto edges = [&] {
    const OpenDomain open(place.volume);
    const EdgeRules rules(open.domain, nodes.position, 3.0 * nodes.spacing);
    return yao_edges(nodes.position, rules, 8, nodes.spacing);
  };
  const std::vector<Edge> many = edges();
  const ThreadLimit limit(1);
  CHECK(many == edges());
}

TEST_CASE("Yao graph: five to six undirected edges a node with octants, about four with cones") {
  const Volume ball{.shape = Shape::sphere, .radius = 2.0};
  const Nodes nodes = scatter_nodes(ball, Vec3(0.0), {.nodes = 8000});
  const OpenDomain open(ball);
  const EdgeRules rules(open.domain, nodes.position, 3.0 * nodes.spacing);
  const auto a_node = [&](int sectors) {
    return static_cast<double>(yao_edges(nodes.position, rules, sectors, nodes.spacing).size()) / 8000;
  };
  CHECK(a_node(8) > 5.0);
  CHECK(a_node(8) < 5.7);
  CHECK(a_node(6) > 3.7);
  CHECK(a_node(6) < 4.3);
}

TEST_CASE("weights: length^p times a factor in its range, from the seed and the edge alone") {
  const Place place = places()[1];
  const Nodes nodes = scatter_nodes(place.volume, place.root, {.nodes = 2000});
  const OpenDomain open(place.volume);
  const EdgeRules rules(open.domain, nodes.position, 3.0 * nodes.spacing);
  Graph graph;
  graph.nodes = nodes.position;
  graph.edges = yao_edges(nodes.position, rules, 8, nodes.spacing);
  for (const double exponent : {0.0, 1.0, 2.5}) {
    assign_random_weights(graph, {.exponent = exponent, .low = 0.25, .high = 0.75, .seed = 9});
    double mean = 0.0;
    for (std::size_t i = 0; i < graph.edges.size(); ++i) {
      const auto& [a, b] = graph.edges[i];
      const double factor =
          graph.weights[i] / std::pow(glm::distance(graph.nodes[a], graph.nodes[b]), exponent);
      REQUIRE(factor >= 0.25 - 1e-6);
      REQUIRE(factor <= 0.75 + 1e-6);
      mean += factor / static_cast<double>(graph.edges.size());
    }
    CHECK(std::abs(mean - 0.5) < 0.01);
  }
  const std::vector<float> weights = graph.weights;
  std::reverse(graph.edges.begin(), graph.edges.end());
  for (Edge& edge : graph.edges) std::swap(edge[0], edge[1]);
  assign_random_weights(graph, {.exponent = 2.5, .low = 0.25, .high = 0.75, .seed = 9});
  CHECK(std::equal(weights.rbegin(), weights.rend(), graph.weights.begin()));
  assign_random_weights(graph, {.exponent = 2.5, .low = 0.25, .high = 0.75, .seed = 10});
  CHECK_FALSE(std::equal(weights.rbegin(), weights.rend(), graph.weights.begin()));
}
