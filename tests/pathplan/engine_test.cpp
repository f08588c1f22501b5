#include "pathplan/engine.h"

#include <algorithm>
#include <map>
#include <set>
#include <stop_token>
#include <tuple>

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

/// A root plate with branches that go straight down from its endpoints.
std::vector<Level> roots() {
  Level level;
  level.volume = {.shape = Shape::hemisphere, .radius = 1.5, .direction = -kUp};
  level.nodes = 800;
  level.b = 6;
  std::vector<Level> levels = {level};
  level.nodes = 60;
  level.b = 8;
  level.r = 0.6;
  level.v_g = Orientation::fixed;
  level.alpha_deg = 60.0;
  levels.push_back(level);
  return levels;
}

/// Trees that are joined name their axes anew.
bool is_same_but_for_names(Skeleton a, const Skeleton& b) {
  a.axis = b.axis;
  return is_same(a, b);
}

std::string error_of(const Parameters& parameters) {
  try {
    Engine::run(parameters, {});
  } catch (const RunError& error) {
    return error.what();
  }
  return {};
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

TEST_CASE("pathplan: endpoints that no path leads to are counted in an error, or left out with a warning") {
  Parameters parameters = small_tree();
  Level& level = parameters.levels.front();
  level.volume = {.shape = Shape::union_of,
                  .parts = {{.shape = Shape::sphere}, {.shape = Shape::sphere, .center = {4.0, 0.0, 0.0}}}};
  level.endpoints = EndpointKind::region;
  CHECK(error_of(parameters) ==
        "100 of 100 endpoints cannot be reached from the root (raise nodes or max_edge, make the volume's "
        "thin places and overlaps wider, or leave them out: pathplan.unreachable = \"warn\")");

  parameters.unreachable = Unreachable::warn;
  level.endpoints = EndpointKind::random;
  level.stages = {{.b = 20, .hops = 2}};
  const RunResult result = run_with_layers(parameters);
  const double unreachable = reported(result, "graph", "unreachable");
  CHECK(unreachable > 30.0);
  CHECK(unreachable < 70.0);
  CHECK(reported(result, "graph", "components") == 2.0);
  CHECK(reported(result, "all_graphs", "endpoints") == 120.0);
  REQUIRE(result.report.warnings.size() == 1);
  CHECK(result.report.warnings[0] ==
        std::to_string(static_cast<int>(unreachable)) +
            " of 120 endpoints cannot be reached from the root: they are left out");
  CHECK(violations(result.skeleton).empty());
  CHECK(static_cast<double>(layer<PointLayer>(result, "endpoints").points.size()) == 120.0 - unreachable);
  for (const Vec3& p : result.skeleton.position) REQUIRE(glm::length(p) <= 1.0);
}

TEST_CASE("pathplan: unreachable endpoints of later levels and of roots are told, too") {
  Parameters parameters = small_tree();
  parameters.levels.push_back(parameters.levels.front());
  Level& later = parameters.levels.back();
  later.nodes = 60;
  later.b = 20;
  later.edges = EdgeKind::threshold;
  later.max_edge = 1.05;  // hardly an edge
  CHECK(error_of(parameters).find(" of 2100 endpoints cannot be reached from the root (") !=
        std::string::npos);

  parameters.levels.pop_back();
  parameters.roots = {parameters.levels.front()};
  parameters.roots.front().edges = EdgeKind::threshold;
  parameters.roots.front().max_edge = 1.0;
  CHECK(error_of(parameters).find("100 of 100 endpoints cannot be reached from the root (") == 0);
}

TEST_CASE("pathplan: more endpoints than there are nodes for is an error that counts them") {
  Parameters parameters = small_tree();
  parameters.levels.front().region = {.shape = Shape::sphere, .center = {0.0, 4.0, 0.0}, .radius = 0.2};
  CHECK(error_of(parameters).find("b: 100 endpoints wanted, ") == 0);

  parameters = small_tree();
  parameters.levels.front().stages = {{.b = 1, .hops = 1}, {.b = 2899, .hops = 1}};
  CHECK(error_of(parameters).find("stages.2.b: 2899 endpoints wanted, ") != std::string::npos);

  parameters = small_tree();
  parameters.levels.front().endpoints = EndpointKind::manual;
  parameters.levels.front().points = {{{0.0, 4.0, 0.0}}, {{0.01, -0.5, 0.0}}};
  CHECK(error_of(parameters) == "points.2: the node nearest to [0.01, -0.5, 0] is the root (farther away)");
}

TEST_CASE(
    "pathplan: where obstacles leave too little room, a later graph has the nodes and endpoints that fit") {
  Parameters parameters = small_tree();
  parameters.levels.front().b = 40;
  parameters.levels.push_back(parameters.levels.front());
  parameters.levels.back().nodes = 60;
  parameters.levels.back().b = 30;
  const RunResult open = run_with_layers(parameters);
  parameters.obstacles = {{{.shape = Shape::sphere, .center = {0.0, 5.2, 0.0}, .radius = 1.5}},
                          {{.shape = Shape::box, .center = {2.6, 3.0, 0.0}, .size = {1.0, 4.0, 6.0}}}};
  const RunResult closed = run_with_layers(parameters);
  CHECK(reported(open, "all_graphs", "endpoints") == 40.0 + 40.0 * 30.0);
  CHECK(reported(closed, "all_graphs", "graphs") == 41.0);
  CHECK(reported(closed, "all_graphs", "nodes") < reported(open, "all_graphs", "nodes"));
  CHECK(reported(closed, "all_graphs", "endpoints") < reported(open, "all_graphs", "endpoints"));
  CHECK(reported(closed, "all_graphs", "endpoints") > 500.0);
  CHECK(closed.report.warnings.empty());
}

TEST_CASE("pathplan: an obstacle that fills the volume is an error, not a search without end") {
  Parameters parameters = small_tree();
  parameters.levels.front().volume = {.shape = Shape::sphere, .center = {0.0, 2.0, 0.0}, .radius = 2.0};
  for (const double height : {3.8, 3.99, 3.9999, 4.5}) {
    INFO("height " << height);
    parameters.obstacles = {
        {{.shape = Shape::box, .center = {0.0, 0.001 + 0.5 * height, 0.0}, .size = {4.5, height, 4.5}}}};
    CHECK(error_of(parameters) ==
          "obstacles: less than 1 % of the volume is free (smaller ones, or beside it)");
  }
}

TEST_CASE("pathplan: roots are a tree below the ground, and the stem is as it would be without them") {
  for (const std::uint64_t seed : {1, 2}) {
    Parameters parameters = small_tree(seed);
    const Skeleton stem = Engine::run(parameters, {}).skeleton;
    parameters.roots = roots();
    CHECK(Engine::check(parameters).empty());
    const RunResult result = run_with_layers(parameters);
    const Skeleton& tree = result.skeleton;
    CHECK(violations(tree).empty());
    REQUIRE(tree.root_count() == 2);
    CHECK(tree.position[0] == tree.position[1]);

    std::vector<bool> is_stem(tree.node_count());
    std::size_t below = 0;
    for (std::size_t node = 0; node < tree.node_count(); ++node) {
      is_stem[node] = tree.kind[node] == Kind::stem;
      if (!tree.is_root(node)) REQUIRE(tree.kind[tree.parent[node]] == tree.kind[node]);
      if (is_stem[node]) continue;
      ++below;
      REQUIRE(tree.position[node].y <= 1e-9);
    }
    CHECK(below > 100);
    CHECK(is_same_but_for_names(subset(tree, is_stem), stem));
    CHECK(reported(result, "all_graphs", "graphs") == 1.0 + 1.0 + 6.0);
    CHECK(reported(result, "all_graphs", "nodes") == 3000.0 + 800.0 + 6.0 * 60.0);
    CHECK(reported(result, "all_graphs", "endpoints") == 100.0 + 6.0 + 6.0 * 8.0);
    CHECK(layer<PointLayer>(result, "endpoints").points.size() == 100);  // layers are the stem's

    for (const int threads : {1, 2, 3}) {
      const ThreadLimit limit(threads);
      CHECK(is_same(tree, Engine::run(parameters, {}).skeleton));
    }
    parameters.seed += 10;
    CHECK(Engine::run(parameters, {}).skeleton.position.back() != tree.position.back());
  }
}

TEST_CASE("pathplan: guided roots begin downwards") {
  Parameters parameters = small_tree();
  parameters.roots = roots();
  parameters.roots.resize(1);
  Level& level = parameters.roots.front();
  level.volume = {.shape = Shape::sphere, .radius = 1.5};  // as much of it above as below
  level.weights = WeightKind::incremental;
  level.guiding.alpha_deg = 30.0;  // were they constant, all ways would add up to the same
  level.b = 60;
  const Skeleton tree = Engine::run(parameters, {}).skeleton;
  Vec3 first(0.0);
  for (std::size_t node = 2; node < tree.node_count(); ++node) {
    if (tree.kind[node] == Kind::root && tree.is_root(tree.parent[node])) first += tree.along(node);
  }
  CHECK(first.y < 0.0);
}

TEST_CASE("pathplan: a stop request in the roots leaves the stem whole") {
  Parameters parameters = small_tree();
  parameters.roots = roots();
  const Skeleton stem = Engine::run(small_tree(), {}).skeleton;
  const std::vector<std::string> stages = {"nodes", "graph", "paths", "level 2"};
  for (const std::string& stage : stages) {
    INFO(stage);
    std::stop_source stop;
    bool is_stem_planned = false;  // its paths are the last it reports
    RunContext context;
    context.stop = stop.get_token();
    context.progress = [&](const Progress& now) {
      if (is_stem_planned && now.stage == stage) stop.request_stop();
      is_stem_planned |= now.stage == "paths";
    };
    const RunResult result = Engine::run(parameters, context);
    CHECK_FALSE(result.is_complete);
    CHECK(violations(result.skeleton).empty());
    std::vector<bool> is_stem;
    for (const Kind kind : result.skeleton.kind) is_stem.push_back(kind == Kind::stem);
    CHECK(is_same_but_for_names(subset(result.skeleton, is_stem), stem));
    const auto below = static_cast<std::size_t>(std::count(is_stem.begin(), is_stem.end(), false));
    CHECK((stage == "level 2" ? below > 10 : below == 1));
  }
}

TEST_CASE("pathplan: guiding vectors have a layer, and an edge one cost each way, by them") {
  Parameters parameters = small_tree();
  CHECK(Engine::layers(parameters) == std::vector<std::string>{"graph", "endpoints"});
  for (const WeightKind kind : {WeightKind::incremental, WeightKind::periodic}) {
    Level& level = parameters.levels.front();
    level.weights = kind;
    CHECK(Engine::layers(parameters) == std::vector<std::string>{"graph", "endpoints", "guiding"});
    const RunResult result = run_with_layers(parameters);
    const auto& guiding = layer<VectorLayer>(result, "guiding");
    const auto& graph = layer<LineLayer>(result, "graph");
    CHECK(guiding.points == graph.points);
    REQUIRE(guiding.vectors.size() == 3000);
    CHECK(guiding.vectors[0] == kUp);
    for (const Vec3& g : guiding.vectors) REQUIRE(std::abs(glm::length(g) - 1.0) < 1e-9);
    REQUIRE(graph.lines.size() == graph.values.size());
    for (std::size_t i = 0; i < graph.lines.size(); ++i) {
      const auto [u, v] = graph.lines[i];
      const auto [back, there] = graph.lines[i ^ 1];
      REQUIRE((u == there && v == back));
      const Vec3 way = graph.points[v] - graph.points[u];
      const double cosine = glm::dot(guiding.vectors[u], glm::normalize(way));
      REQUIRE(std::abs(graph.values[i] - glm::length(way) * (1.0 - cosine + level.guiding.epsilon)) < 1e-6);
    }
  }
}

TEST_CASE("pathplan: it registers under its name, with seed and steps at the top") {
  EngineRegistry registry;
  register_engine(registry);
  const AnyEngine* engine = registry.find("pathplan");
  REQUIRE(engine != nullptr);
  CHECK(engine->top_fields.size() == 2);
  CHECK(engine->steps(engine->make_parameters().get()) == 1);
}
