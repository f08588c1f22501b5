#include "pathplan/endpoints.h"

#include <set>

#include "common/base/errors.h"
#include "tests/catch.h"
#include "tests/pathplan/graphs.h"

using namespace ramify;
using namespace ramify::pathplan;
using namespace ramify::test;

namespace {

Level level_of(EndpointKind kind, int b) {
  Level level;
  level.endpoints = kind;
  level.b = b;
  return level;
}

std::vector<Vec3> nodes_of(const Level& level, int count) {
  return scatter_nodes(level.volume, Vec3(0.0), {.nodes = count}).position;
}

/// As the engine asks for them at level 1.
std::vector<std::uint32_t> choose(std::span<const Vec3> nodes, const Level& level, std::uint64_t seed) {
  const Solid region(endpoint_region(level));
  return choose_endpoints({.nodes = nodes, .region = &region}, {.kind = level.endpoints,
                                                                .b = level.b,
                                                                .shell_thickness = level.shell_thickness,
                                                                .points = level.points,
                                                                .seed = seed});
}

template <class Choose>
std::string error_in(const Choose& choose) {
  try {
    choose();
  } catch (const RunError& error) {
    return error.what();
  }
  return {};
}

std::string error_of(std::span<const Vec3> nodes, const Level& level) {
  return error_in([&] { choose(nodes, level, 1); });
}

/// A chain of so many nodes, 1 m apart, and what a search finds in it.
struct Chain {
  explicit Chain(std::uint32_t nodes) : paths(nodes) {
    std::vector<Vec3> positions;
    std::vector<Edge> edges;
    for (std::uint32_t i = 0; i < nodes; ++i) positions.emplace_back(i, 0.0, 0.0);
    for (std::uint32_t i = 1; i < nodes; ++i) edges.push_back({i - 1, i});
    graph = graph_of(positions, edges, std::vector<float>(edges.size(), 1.0f));
  }
  void add_path_to(std::uint32_t node) {
    paths.add(shortest_paths(graph, paths.nodes()), std::vector<std::uint32_t>{node});
  }

  Graph graph;
  PathUnion paths;
};

}  // namespace

TEST_CASE("endpoints: b distinct nodes where their kind allows them, never the root") {
  const std::vector<Vec3> nodes = nodes_of({}, 6000);
  for (const EndpointKind kind : {EndpointKind::random, EndpointKind::region, EndpointKind::shell}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      const Level level = level_of(kind, 300);
      const std::vector<std::uint32_t> endpoints = choose(nodes, level, seed);
      CHECK(endpoints.size() == 300);
      CHECK(std::set<std::uint32_t>(endpoints.begin(), endpoints.end()).size() == 300);
      const Volume& crown = level.volume.parts[1];
      for (const std::uint32_t node : endpoints) {
        REQUIRE(node > 0);
        REQUIRE(node < nodes.size());
        if (kind != EndpointKind::random) REQUIRE(contains(crown, nodes[node]));
        if (kind == EndpointKind::shell) {
          REQUIRE(crown.radius - glm::distance(nodes[node], crown.center) <= level.shell_thickness);
        }
      }
    }
  }
}

TEST_CASE("endpoints: a region of one's own takes the crown's place") {
  const std::vector<Vec3> nodes = nodes_of({}, 6000);
  Level level = level_of(EndpointKind::region, 20);
  level.region = {.shape = Shape::sphere, .center = {2.0, 6.0, 0.0}, .radius = 1.0};
  for (const std::uint32_t node : choose(nodes, level, 1)) CHECK(contains(level.region, nodes[node]));
}

TEST_CASE("endpoints: the crown is all parts but the first, or the only one") {
  Level level;
  level.volume.parts.push_back({.shape = Shape::sphere, .center = {0.0, 12.0, 0.0}});
  CHECK(contains(endpoint_region(level), {0.0, 12.5, 0.0}));
  CHECK(contains(endpoint_region(level), {0.0, 9.0, 0.0}));
  CHECK_FALSE(contains(endpoint_region(level), {0.0, 1.0, 0.0}));
  level.volume = {.shape = Shape::cone, .height = 4.0};
  CHECK(contains(endpoint_region(level), {0.0, 1.0, 0.0}));
}

TEST_CASE("endpoints: every node is as likely as every other") {
  const std::vector<Vec3> nodes = nodes_of({}, 31);
  std::vector<int> chosen(nodes.size(), 0);
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    for (const std::uint32_t node : choose(nodes, level_of(EndpointKind::random, 5), seed)) {
      ++chosen[node];
    }
  }
  CHECK(chosen[0] == 0);
  // 500 each on average, with a standard deviation of 20.
  for (std::size_t node = 1; node < nodes.size(); ++node) CHECK(std::abs(chosen[node] - 500) < 90);
}

TEST_CASE("endpoints: all nodes but the root may be asked for, one more is an error that counts them") {
  const std::vector<Vec3> nodes = nodes_of({}, 50);
  CHECK(choose(nodes, level_of(EndpointKind::random, 49), 1).size() == 49);
  CHECK(error_of(nodes, level_of(EndpointKind::random, 50)) ==
        "b: 50 endpoints wanted, 49 nodes beside the root (more nodes, fewer endpoints or a larger place)");

  Level level = level_of(EndpointKind::region, 49);
  level.region = {.shape = Shape::sphere, .center = {0.0, 1.0, 0.0}, .radius = 0.01};
  CHECK(error_of(nodes, level) ==
        "b: 49 endpoints wanted, 0 nodes in the region (more nodes, fewer endpoints or a larger place)");
  level = level_of(EndpointKind::shell, 49);
  level.shell_thickness = 1e-6;
  CHECK(error_of(nodes, level) ==
        "b: 49 endpoints wanted, 0 nodes in the shell of 1e-06 m (more nodes, fewer endpoints or a larger "
        "place)");
}

TEST_CASE("endpoints: only nodes that come into question are chosen") {
  const std::vector<Vec3> nodes = nodes_of({}, 500);
  const auto is_even = [](std::uint32_t node) { return node % 2 == 0; };
  const std::vector<std::uint32_t> chosen =
      choose_endpoints({.nodes = nodes, .is_fit = is_even}, {.b = 249, .seed = 1});
  CHECK(chosen.size() == 249);  // all of them but the root
  for (const std::uint32_t node : chosen) CHECK(node % 2 == 0);
}

TEST_CASE("endpoints: subvolumes get the same number, the first ones more by one, and the trunk none") {
  const std::vector<Vec3> nodes = nodes_of({}, 1000);
  const std::vector<std::uint32_t> subvolumes = drawn_subvolumes(nodes.size(), 5, 1);
  for (const int b : {4, 100, 103}) {
    for (const std::uint64_t seed : {1, 2}) {
      const std::vector<std::uint32_t> chosen =
          choose_endpoints({.nodes = nodes, .subvolumes = subvolumes}, {.b = b, .seed = seed});
      std::vector<int> share(5, 0);
      for (const std::uint32_t node : chosen) ++share[subvolumes[node]];
      CHECK(std::set<std::uint32_t>(chosen.begin(), chosen.end()).size() == chosen.size());
      CHECK(share == std::vector<int>{0, (b + 3) / 4, (b + 2) / 4, (b + 1) / 4, b / 4});
    }
  }
}

TEST_CASE("endpoints: a subvolume with too few nodes is an error that names its sphere") {
  const std::vector<Vec3> nodes(8, Vec3(0.0));
  const std::vector<std::uint32_t> subvolumes = {0, 1, 1, 1, 2, 2, 3, 3};
  const Candidates candidates{.nodes = nodes, .subvolumes = subvolumes};
  CHECK(choose_endpoints(candidates, {.b = 6}).size() == 6);
  CHECK(error_in([&] { choose_endpoints(candidates, {.b = 8}); }) ==
        "b: 3 endpoints wanted in sphere 2, 2 nodes there (more nodes, fewer endpoints or larger spheres)");
  CHECK(choose_endpoints(candidates, {.b = 8, .must_be_all = false}).size() == 7);
}

TEST_CASE("endpoints: where not all must be, there are as many as fit") {
  const std::vector<Vec3> nodes = nodes_of({}, 50);
  CHECK(choose_endpoints({.nodes = nodes}, {.b = 70, .must_be_all = false}).size() == 49);
}

TEST_CASE("endpoints: manual ones are the nearest nodes, each once, and never the root") {
  const std::vector<Vec3> nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  const std::vector<ManualPoint> points = {
      {{2.9, 5.0, 0.0}}, {{1.4, 0.0, 0.0}}, {{3.4, 0.0, 0.0}}, {{0.6, 0, 0}}};
  CHECK(choose_endpoints({.nodes = nodes}, {.kind = EndpointKind::manual, .points = points}) ==
        std::vector<std::uint32_t>{3, 1});
  const std::vector<ManualPoint> near_root = {{{2.0, 0.0, 0.0}}, {{0.25, -7.5, 0.0}}};
  CHECK(error_in([&] {
          choose_endpoints({.nodes = nodes}, {.kind = EndpointKind::manual, .points = near_root});
        }) == "points.2: the node nearest to [0.25, -7.5, 0] is the root (farther away)");
}

TEST_CASE("endpoints: those of a stage are off the paths, but at most so many edges away") {
  Chain chain(30);
  chain.add_path_to(9);
  for (const std::uint64_t seed : {1, 2, 3}) {
    std::vector<std::uint32_t> chosen =
        choose_nearby_endpoints(chain.graph, chain.paths, {.b = 4, .hops = 4}, 1, true, seed);
    std::sort(chosen.begin(), chosen.end());
    CHECK(chosen == std::vector<std::uint32_t>{10, 11, 12, 13});
  }
  std::set<std::uint32_t> met;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    met.insert(choose_nearby_endpoints(chain.graph, chain.paths, {.b = 1, .hops = 3}, 1, true, seed).front());
  }
  CHECK(met == std::set<std::uint32_t>{10, 11, 12});

  const Graph graph = graph_in(places()[1], 2000, {});
  PathUnion paths(graph.nodes.size());
  paths.add(shortest_paths(graph, kRoot), std::vector<std::uint32_t>{500, 1000, 1500});
  // The fewest edges to the paths, by searching with weights of 1.
  const Graph unweighted = graph_of(graph.nodes, graph.edges, std::vector<float>(graph.edges.size(), 1.0f));
  const std::vector<double> edges_away = shortest_paths(unweighted, paths.nodes()).cost;
  for (const int hops : {1, 2, 5}) {
    const auto within = std::count_if(edges_away.begin(), edges_away.end(),
                                      [&](double edges) { return edges > 0.0 && edges <= hops; });
    const std::vector<std::uint32_t> all =
        choose_nearby_endpoints(graph, paths, {.b = static_cast<int>(within), .hops = hops}, 1, true, 1);
    for (const std::uint32_t node : all) REQUIRE((edges_away[node] > 0.0 && edges_away[node] <= hops));
    CHECK(std::set<std::uint32_t>(all.begin(), all.end()).size() == static_cast<std::size_t>(within));
  }
}

TEST_CASE("endpoints: a stage with too few nodes near the paths is an error that counts them") {
  Chain chain(30);
  chain.add_path_to(20);
  const auto choose_five = [&](bool must_be_all) {
    return choose_nearby_endpoints(chain.graph, chain.paths, {.b = 5, .hops = 3}, 2, must_be_all, 1);
  };
  CHECK(error_in([&] { choose_five(true); }) ==
        "stages.2.b: 5 endpoints wanted, 3 nodes within 3 hops of the paths (fewer endpoints or more hops)");
  CHECK(choose_five(false).size() == 3);
}
