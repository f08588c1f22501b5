#include "pathplan/yao_graph.h"

#include <algorithm>

#include "common/base/parallel.h"
#include "tests/catch.h"
#include "tests/pathplan/graphs.h"

using namespace ramify;
using namespace ramify::pathplan;
using namespace ramify::test;

namespace {

/// The direction that a difference is nearest to, by angle: of the faces of a cube, or of its faces and
/// corners; with octants, the corner on its side.
int sector_of(const Vec3& d, int sectors) {
  if (sectors == 8) return (d.x < 0 ? 1 : 0) + (d.y < 0 ? 2 : 0) + (d.z < 0 ? 4 : 0);
  std::vector<Vec3> directions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int corner = 0; corner < 8 && sectors == 14; ++corner) {
    const Vec3 signs(corner & 1, corner >> 1 & 1, corner >> 2);
    directions.push_back(glm::normalize(1.0 - 2.0 * signs));
  }
  const auto is_less = [&](const Vec3& a, const Vec3& b) { return glm::dot(a, d) < glm::dot(b, d); };
  return static_cast<int>(std::max_element(directions.begin(), directions.end(), is_less) -
                          directions.begin());
}

/// The definition, every pair looked at.
std::set<Edge> edges_by_hand(const std::vector<Vec3>& nodes, const PlainRules& rules, int sectors) {
  std::set<Edge> edges;
  for (std::uint32_t u = 0; u < nodes.size(); ++u) {
    std::vector<std::pair<double, std::uint32_t>> best(static_cast<std::size_t>(sectors), {1e300, 0});
    for (std::uint32_t v = 0; v < nodes.size(); ++v) {
      if (u == v || !rules.allow(nodes, u, v)) continue;
      const Vec3 d = nodes[v] - nodes[u];
      auto& nearest = best[static_cast<std::size_t>(sector_of(d, sectors))];
      nearest = std::min(nearest, {glm::dot(d, d), v});
    }
    for (const auto& [square, v] : best) {
      if (square < 1e300) edges.insert({std::min(u, v), std::max(u, v)});
    }
  }
  return edges;
}

}  // namespace

TEST_CASE("Yao graph: each node is joined to the nearest allowed node of each sector, as every pair shows") {
  for (const Place& place : places()) {
    for (const std::uint64_t seed : {1, 2}) {
      const Nodes nodes = scatter_nodes(place.volume, place.root, {.nodes = 350}, seed);
      const OpenDomain open(place.volume);
      for (const int sectors : {6, 8, 14}) {
        for (const double max_edge : {1.2, 3.0, 30.0}) {
          INFO(place.name << ", seed " << seed << ", " << sectors << " sectors, max_edge " << max_edge);
          const double max_length = max_edge * nodes.spacing;
          const EdgeRules rules(open.domain, nodes.position, max_length);
          const std::vector<Edge> edges = yao_edges(nodes.position, rules, sectors, nodes.spacing);
          CHECK(as_set(edges).size() == edges.size());  // each once
          CHECK(as_set(edges) == edges_by_hand(nodes.position, {open.solid, max_length}, sectors));
        }
      }
    }
  }
}

TEST_CASE(
    "Yao graph: a node behind an obstacle or in another subvolume gives its place to the next nearest") {
  for (const Place& place : places()) {
    const Nodes nodes = scatter_nodes(place.volume, place.root, {.nodes = 350}, 3);
    const BallAndWall things{
        .center = place.root + Vec3(0.3, 0.9, 0.1),
        .radius = 0.5,
        .wall = {place.root + Vec3(0.2, -3.0, -3.0), place.root + Vec3(0.201, 3.0, 3.0)}};
    Parameters parameters;
    parameters.obstacles = things.obstacles();
    const Surroundings obstructed(parameters);
    const OpenDomain open(place.volume);
    const Domain closed{open.solid, obstructed};
    const std::vector<std::uint32_t> subvolumes = drawn_subvolumes(nodes.position.size(), 4, 5);
    for (const int sectors : {6, 8, 14}) {
      for (const double max_edge : {1.5, 3.0, 30.0}) {
        INFO(place.name << ", " << sectors << " sectors, max_edge " << max_edge);
        const double max_length = max_edge * nodes.spacing;
        const EdgeRules behind(closed, nodes.position, max_length);
        CHECK(as_set(yao_edges(nodes.position, behind, sectors, nodes.spacing)) ==
              edges_by_hand(nodes.position, {open.solid, max_length, &things}, sectors));
        const EdgeRules elsewhere(open.domain, nodes.position, max_length, subvolumes);
        CHECK(as_set(yao_edges(nodes.position, elsewhere, sectors, nodes.spacing)) ==
              edges_by_hand(nodes.position, {open.solid, max_length, nullptr, subvolumes}, sectors));
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
    for (const int sectors : {6, 8, 14}) {
      const OpenDomain open(room);
      const EdgeRules rules(open.domain, nodes, 3.0);
      CHECK(as_set(yao_edges(nodes, rules, sectors, 1.0)) ==
            edges_by_hand(nodes, {open.solid, 3.0}, sectors));
    }
  }
}

TEST_CASE("Yao graph: it is right where nodes are too far from each other for single precision") {
  const Volume room{.shape = Shape::sphere, .radius = 1e9};
  const OpenDomain open(room);
  std::vector<Vec3> nodes =
      scatter_nodes({.shape = Shape::sphere, .radius = 2.0}, Vec3(0.0), {.nodes = 150}).position;
  const std::size_t count = nodes.size();
  for (std::size_t i = 0; i < count; ++i) nodes.push_back(nodes[i] + Vec3(3e7, 1e6, -2e7));
  const EdgeRules rules(open.domain, nodes, 2.0);
  for (const int sectors : {6, 8, 14}) {
    CHECK(as_set(yao_edges(nodes, rules, sectors, 0.5)) == edges_by_hand(nodes, {open.solid, 2.0}, sectors));
  }
}

TEST_CASE("Yao graph: it is right where nodes fill many layers of cells, which are shared out") {
  const Volume pole{.shape = Shape::cylinder, .radius = 0.3, .height = 30.0, .direction = {0.0, 0.0, 1.0}};
  const Nodes nodes = scatter_nodes(pole, Vec3(0.0), {.nodes = 1500});
  const OpenDomain open(pole);
  const double max_length = 3.0 * nodes.spacing;
  const EdgeRules rules(open.domain, nodes.position, max_length);
  CHECK(as_set(yao_edges(nodes.position, rules, 8, nodes.spacing)) ==
        edges_by_hand(nodes.position, {open.solid, max_length}, 8));
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

TEST_CASE(
    "Yao graph: five to six undirected edges a node with octants, about four with cones, nine with 14 "
    "sectors") {
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
  CHECK(a_node(14) > 8.0);
  CHECK(a_node(14) < 10.0);
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
