#include "pathplan/engine.h"

#include <algorithm>
#include <map>
#include <set>
#include <stop_token>

#include "common/base/errors.h"
#include "common/base/parallel.h"
#include "tests/catch.h"
#include "tests/pathplan/graphs.h"

using namespace ramify;
using namespace ramify::pathplan;
using namespace ramify::test;

namespace {

Parameters small_tree(std::uint64_t seed = 1) {
  Parameters parameters;
  parameters.seed = seed;
  parameters.levels.front().volume = places()[1].volume;
  parameters.levels.front().nodes = 3000;
  parameters.levels.front().b = 100;
  return parameters;
}

/// A run that asks itself to stop when it reaches a stage.
RunResult run_stopped_at(std::string_view stage) {
  std::stop_source stop;
  RunContext context;
  context.stop = stop.get_token();
  context.progress = [&](const Progress& now) {
    if (now.stage == stage) stop.request_stop();
  };
  return Engine::run(small_tree(), context);
}

}  // namespace

TEST_CASE("pathplan: every volume, seed and kind of endpoint makes a sound tree with all its endpoints") {
  for (const Place& place : places()) {
    for (const EndpointKind kind : {EndpointKind::random, EndpointKind::region, EndpointKind::shell}) {
      for (const std::uint64_t seed : {1, 2}) {
        INFO(place.name << ", seed " << seed);
        Parameters parameters = small_tree(seed);
        parameters.root = place.root;
        parameters.levels.front().volume = place.volume;
        parameters.levels.front().endpoints = kind;
        parameters.levels.front().sectors = seed == 1 ? 8 : 6;
        CHECK(Engine::check(parameters).empty());
        const RunResult result = run_with_layers(parameters);
        const Skeleton& tree = result.skeleton;
        CHECK(result.is_complete);
        CHECK(violations(tree).empty());
        CHECK(tree.root_count() == 1);
        CHECK(tree.position.front() == place.root);

        const auto less = [](const Vec3& a, const Vec3& b) {
          return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        };
        const std::set<Vec3, decltype(less)> positions(tree.position.begin(), tree.position.end(), less);
        CHECK(positions.size() == tree.node_count());
        const auto& endpoints = layer<PointLayer>(result, "endpoints").points;
        CHECK(endpoints.size() == 100);
        for (const Vec3& endpoint : endpoints) CHECK(positions.count(endpoint) == 1);
      }
    }
  }
}

TEST_CASE(
    "pathplan: no width grows towards the tips, the base is the trunk's and no tip is thinner than allowed") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    for (const double zeta : {0.0, 0.3, 1.2, 3.0}) {
      Parameters parameters = small_tree(seed);
      parameters.levels.front().zeta = zeta;
      const Skeleton tree = Engine::run(parameters, {}).skeleton;
      CHECK(std::abs(tree.diameter[0] - parameters.trunk_diameter) < 1e-12);
      for (std::size_t node = 1; node < tree.node_count(); ++node) {
        REQUIRE(tree.diameter[node] <= tree.diameter[tree.parent[node]]);
        REQUIRE(tree.diameter[node] >= parameters.tip_diameter);
      }
    }
  }
}

TEST_CASE("pathplan: an axis never gets an internode that is no edge of the graph") {
  const RunResult result = run_with_layers(small_tree());
  const auto& graph = layer<LineLayer>(result, "graph");
  std::map<std::pair<double, double>, std::uint32_t> number;
  for (std::uint32_t i = 0; i < graph.points.size(); ++i) number[{graph.points[i].x, graph.points[i].z}] = i;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& [a, b] : graph.lines) edges.insert({std::min(a, b), std::max(a, b)});
  const Skeleton& tree = result.skeleton;
  for (std::size_t node = 1; node < tree.node_count(); ++node) {
    const Vec3& from = tree.position[tree.parent[node]];
    const Vec3& to = tree.position[node];
    const std::uint32_t a = number.at({from.x, from.z});
    const std::uint32_t b = number.at({to.x, to.z});
    REQUIRE(edges.count({std::min(a, b), std::max(a, b)}) == 1);
  }
}

TEST_CASE("pathplan: the seed changes the tree, the number of threads does not") {
  const RunResult tree = run_with_layers(small_tree(1));
  CHECK(is_same(tree.skeleton, run_with_layers(small_tree(1)).skeleton));
  CHECK_FALSE(is_same(tree.skeleton, run_with_layers(small_tree(2)).skeleton));
  for (const int threads : {1, 2, 3}) {
    const ThreadLimit limit(threads);
    const RunResult again = run_with_layers(small_tree(1));
    CHECK(is_same(tree.skeleton, again.skeleton));
    CHECK(layer<LineLayer>(tree, "graph").lines == layer<LineLayer>(again, "graph").lines);
    CHECK(layer<LineLayer>(tree, "graph").values == layer<LineLayer>(again, "graph").values);
  }
}

TEST_CASE("pathplan: the report has the stages and the graph's statistics") {
  const RunResult result = run_with_layers(small_tree());
  std::vector<std::string> stages;
  for (const auto& [stage, seconds] : result.report.seconds) {
    stages.push_back(stage);
    CHECK(seconds >= 0.0);
  }
  CHECK(stages == std::vector<std::string>{"nodes", "graph", "paths", "tree"});
  REQUIRE(result.report.groups.size() == 2);
  CHECK(result.report.groups[0].name == "graph");
  const auto& values = result.report.groups[0].values;
  REQUIRE(values.size() == 5);
  const auto& graph = layer<LineLayer>(result, "graph");
  CHECK(values[0] == std::pair<std::string, double>("nodes", 3000.0));
  CHECK(values[1] == std::pair<std::string, double>("edges", graph.lines.size()));
  CHECK(values[2] == std::pair<std::string, double>("edges_per_node", values[1].second / 3000.0));
  CHECK(values[3] == std::pair<std::string, double>("components", 1.0));
  CHECK(values[4] == std::pair<std::string, double>("unreachable", 0.0));
}

TEST_CASE("pathplan: layers are made where they are wanted, one entry for each point and line") {
  CHECK(Engine::run(small_tree(), {}).layers.empty());
  const RunResult result = run_with_layers(small_tree());
  const auto& graph = layer<LineLayer>(result, "graph");
  CHECK(graph.points.size() == 3000);
  CHECK(graph.point_values == std::vector<double>(3000, 0.0));
  CHECK(graph.values.size() == graph.lines.size());
  for (const double weight : graph.values) REQUIRE(weight > 0.0);
}

TEST_CASE("pathplan: a run that is stopped returns a root without internodes, at whatever stage") {
  for (const std::string_view stage : {"nodes", "graph", "paths"}) {
    INFO(stage);
    const RunResult result = run_stopped_at(stage);
    CHECK_FALSE(result.is_complete);
    CHECK(violations(result.skeleton).empty());
    CHECK(result.skeleton.node_count() == 1);
    CHECK(result.skeleton.diameter[0] == 0.5);
    CHECK(result.report.warnings.empty());
  }
  CHECK(run_stopped_at("tree").is_complete);  // nothing is left to stop
}

TEST_CASE("pathplan: endpoints that no path leads to are counted in an error") {
  Parameters parameters = small_tree();
  Level& level = parameters.levels.front();
  level.volume = {.shape = Shape::union_of,
                  .parts = {{.shape = Shape::sphere}, {.shape = Shape::sphere, .center = {4.0, 0.0, 0.0}}}};
  level.endpoints = EndpointKind::region;
  try {
    Engine::run(parameters, {});
    FAIL("no error");
  } catch (const RunError& error) {
    const std::string message = error.what();
    CHECK(message.find("100 of 100 endpoints cannot be reached from the root (raise nodes or max_edge, ") ==
          0);
    CHECK(message.find("pathplan.unreachable = \"warn\"") != std::string::npos);
  }
}

TEST_CASE("pathplan: more endpoints than the region has nodes is an error that counts them") {
  Parameters parameters = small_tree();
  parameters.levels.front().region = {.shape = Shape::sphere, .center = {0.0, 4.0, 0.0}, .radius = 0.2};
  CHECK_THROWS_AS(Engine::run(parameters, {}), RunError);
}

TEST_CASE("pathplan: it registers under its name, with seed and steps at the top") {
  EngineRegistry registry;
  register_engine(registry);
  const AnyEngine* engine = registry.find("pathplan");
  REQUIRE(engine != nullptr);
  CHECK(engine->top_fields.size() == 2);
  CHECK(engine->steps(engine->make_parameters().get()) == 1);
}
