#include "pathplan/threshold_graph.h"

#include "common/base/parallel.h"
#include "tests/catch.h"
#include "tests/pathplan/graphs.h"

using namespace ramify;
using namespace ramify::pathplan;
using namespace ramify::test;

namespace {

std::set<Edge> edges_by_hand(const std::vector<Vec3>& nodes, const PlainRules& rules) {
  std::set<Edge> edges;
  for (std::uint32_t u = 0; u < nodes.size(); ++u) {
    for (std::uint32_t v = u + 1; v < nodes.size(); ++v) {
      if (rules.allow(nodes, u, v)) edges.insert({u, v});
    }
  }
  return edges;
}

/// In a ball, which is convex: the reach alone decides.
Graph graph_of_reach(const std::vector<Vec3>& nodes, const Volume& ball, double reach) {
  const OpenDomain open(ball);
  const EdgeRules rules(open.domain, nodes, reach);
  std::vector<Edge> edges = threshold_edges(nodes, rules);
  const std::vector<float> weights(edges.size(), 1.0f);
  return graph_of(nodes, std::move(edges), weights);
}

}  // namespace

TEST_CASE("threshold graph: all pairs as near as allowed, that far included") {
  const Volume room{.shape = Shape::sphere, .radius = 100.0};
  const std::vector<Vec3> nodes = {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {0, 1, 0}, {7, 0, 0}};
  CHECK(as_set(graph_of_reach(nodes, room, 2.0).edges) == std::set<Edge>{{0, 1}, {0, 3}, {1, 2}});
}

TEST_CASE("threshold graph: it has the edges that a look at every pair finds, each once") {
  for (const Place& place : places()) {
    for (const std::uint64_t seed : {1, 2}) {
      const Nodes nodes = scatter_nodes(place.volume, place.root, {.nodes = 350}, seed);
      const BallAndWall things{
          .center = place.root + Vec3(0.3, 0.9, 0.1),
          .radius = 0.5,
          .wall = {place.root + Vec3(0.2, -3.0, -3.0), place.root + Vec3(0.201, 3.0, 3.0)}};
      Parameters parameters;
      parameters.obstacles = things.obstacles();
      const Surroundings obstructed(parameters);
      const OpenDomain open(place.volume);
      const Domain closed{open.solid, obstructed};
      for (const double max_edge : {1.0, 1.7, 4.0, 50.0}) {
        INFO(place.name << ", seed " << seed << ", max_edge " << max_edge);
        const double reach = max_edge * nodes.spacing;
        const auto check = [&](const EdgeRules& rules, const PlainRules& plain) {
          const std::vector<Edge> edges = threshold_edges(nodes.position, rules);
          CHECK(as_set(edges).size() == edges.size());
          CHECK(as_set(edges) == edges_by_hand(nodes.position, plain));
        };
        check(EdgeRules(open.domain, nodes.position, reach), {open.solid, reach});
        check(EdgeRules(closed, nodes.position, reach), {open.solid, reach, &things});
        const std::vector<std::uint32_t> subvolumes = drawn_subvolumes(nodes.position.size(), 3, seed);
        check(EdgeRules(open.domain, nodes.position, reach, subvolumes),
              {open.solid, reach, nullptr, subvolumes});
      }
    }
  }
}

TEST_CASE("threshold graph: a Yao graph's edges are among those of the same reach, a quarter of them") {
  for (const Place& place : places()) {
    const Nodes nodes = scatter_nodes(place.volume, place.root, {.nodes = 6000});
    const OpenDomain open(place.volume);
    const EdgeRules rules(open.domain, nodes.position, 3.0 * nodes.spacing);
    const std::set<Edge> all = as_set(threshold_edges(nodes.position, rules));
    for (const int sectors : {6, 8, 14}) {
      const std::set<Edge> yao = as_set(yao_edges(nodes.position, rules, sectors, nodes.spacing));
      CHECK(std::includes(all.begin(), all.end(), yao.begin(), yao.end()));
      if (sectors != 8) continue;
      const double share = static_cast<double>(yao.size()) / static_cast<double>(all.size());
      INFO(place.name << ", " << share);
      CHECK(share > 0.22);
      CHECK(share < 0.32);
    }
  }
}

TEST_CASE("threshold graph: nodes as evenly spread hold together with two thirds of a Yao graph's edges") {
  const Volume ball{.shape = Shape::sphere, .radius = 2.0};
  for (const std::uint64_t seed : {1, 2}) {
    const Nodes nodes = scatter_nodes(ball, Vec3(0.0), {.nodes = 6000}, seed);
    const OpenDomain open(ball);
    const EdgeRules rules(open.domain, nodes.position, 3.0 * nodes.spacing);
    const std::size_t yao = yao_edges(nodes.position, rules, 8, nodes.spacing).size();
    double whole = 3.0;  // the least reach at which it is of one piece, in spacings
    double apart = 1.0;
    while (whole - apart > 0.001) {
      const double middle = 0.5 * (whole + apart);
      const Graph graph = graph_of_reach(nodes.position, ball, middle * nodes.spacing);
      (component_count(graph) == 1 ? whole : apart) = middle;
    }
    const Graph least = graph_of_reach(nodes.position, ball, whole * nodes.spacing);
    const double share = static_cast<double>(least.edges.size()) / static_cast<double>(yao);
    INFO("reach " << whole << " spacings, share " << share);
    CHECK(share > 0.55);
    CHECK(share < 0.7);
  }
}

TEST_CASE("threshold graph: it is the same for any number of threads") {
  const Place place = places()[1];
  const Nodes nodes = scatter_nodes(place.volume, place.root, {.nodes = 5000});
  const OpenDomain open(place.volume);
  const EdgeRules rules(open.domain, nodes.position, 1.6 * nodes.spacing);
  const std::vector<Edge> many = threshold_edges(nodes.position, rules);
  const ThreadLimit limit(1);
  CHECK(many == threshold_edges(nodes.position, rules));
}
