#include "pathplan/levels.h"

#include <functional>
#include <tuple>

#include "common/base/parallel.h"
#include "pathplan/orientation.h"
#include "pathplan/subgraph_volume.h"
#include "tests/catch.h"
#include "tests/pathplan/graphs.h"

using namespace ramify;
using namespace ramify::pathplan;
using namespace ramify::test;

namespace {

const BallAndWall kBallAndWall{
    .center = {1.2, 3.6, 0.4}, .radius = 0.6, .wall = {Vec3(-4.0, 3.4, -1.5), Vec3(-0.4, 3.41, 1.5)}};

/// A mushroom and graphs about its endpoints. No numbers are alike, so that no row can stand for another.
Parameters tree_of(std::size_t levels, std::uint64_t seed = 1) {
  Parameters parameters;
  parameters.seed = seed;
  Level level;
  level.volume = places()[1].volume;
  level.r = 1.1;
  level.a = 0.6;
  const int nodes[] = {1500, 70, 40, 25};
  const int b[] = {13, 5, 3, 2};
  for (std::size_t i = 0; i < levels; ++i) {
    level.nodes = nodes[i];
    level.b = b[i];
    level.alpha_deg = 50.0 - 5.0 * static_cast<double>(i);
    parameters.levels.resize(i);
    parameters.levels.push_back(level);
  }
  return parameters;
}

struct Case {
  std::string name;
  Parameters parameters;
  bool has_all_graphs = true;  // each endpoint gets one, with all that its row wants
};

/// Every choice that a config has, on a tree of three levels.
std::vector<Case> cases() {
  std::vector<Case> cases;
  const auto add = [&](const std::string& name, const std::function<void(Parameters&)>& change,
                       bool has_all_graphs = true) {
    cases.push_back({name, tree_of(3), has_all_graphs});
    change(cases.back().parameters);
  };
  const auto later = [](const std::function<void(Level&)>& change) {
    return [change](Parameters& p) {
      for (std::size_t i = 1; i < p.levels.size(); ++i) change(p.levels[i]);
    };
  };
  const auto all = [](const std::function<void(Level&)>& change) {
    return [change](Parameters& p) {
      for (Level& level : p.levels) change(level);
    };
  };
  for (const std::size_t levels : {1, 2, 3, 4}) {
    add("levels", [&](Parameters& p) { p = tree_of(levels); });
  }
  for (const SubgraphShape shape :
       {SubgraphShape::cone, SubgraphShape::inverted_cone, SubgraphShape::ellipsoid, SubgraphShape::custom}) {
    add("shape", later([&](Level& l) {
          l.subgraph = shape;
          if (shape == SubgraphShape::custom) {
            l.volume = {.shape = Shape::cylinder, .radius = 0.4, .height = 1.0};
          }
        }));
  }
  add("wide", later([](Level& l) { l.alpha_deg = 150.0; }));
  add("fixed", later([](Level& l) {
        l.v_g = Orientation::fixed;
        l.v_g_direction = {1.0, -2.0, 0.5};
      }));
  add("random", later([](Level& l) { l.v_g = Orientation::random; }));
  add("up", later([](Level& l) { l.turn_deg = 35.0; }));
  add("down", later([](Level& l) { l.turn_deg = -50.0; }));
  add("pull", [](Parameters& p) { p.light = {.direction = {1.0, 1.0, 0.0}, .pull = 2.0}; });
  add("around all", [](Parameters& p) {
    p = tree_of(4);
    p.levels[2].around = Around::all;
  });
  add("around all twice", [](Parameters& p) {
    p = tree_of(4);
    p.levels[2].around = p.levels[3].around = Around::all;
  });
  add(
      "distribution",
      [](Parameters& p) {
        p = tree_of(4);
        p.lifespan.rule = LifespanRule::distribution;
      },
      false);
  add(
      "row by lifespan",
      [](Parameters& p) {
        p = tree_of(4);
        p.lifespan = {.rule = LifespanRule::distribution, .p_stop = 0.1, .row_by = RowBy::lifespan};
      },
      false);
  add(
      "light",
      [](Parameters& p) {
        p.light = {.direction = {1.0, 0.5, 0.0}, .decrement_high = 2, .b_low = 0.2, .b_high = 1.8};
      },
      false);
  add(
      "obstacles", [](Parameters& p) { p.obstacles = kBallAndWall.obstacles(); }, false);
  add("costs", [](Parameters& p) {
    p.costs = {{{.shape = Shape::sphere, .center = {0.0, 4.0, 0.0}, .radius = 2.0}, 30.0}};
  });
  add("stages", [](Parameters& p) {
    p.levels[0].stages = {{.b = 7, .hops = 2}, {.b = 4, .hops = 1}};
    p.levels[1].stages = {{.b = 3, .hops = 3}};
  });
  for (const WeightKind kind : {WeightKind::incremental, WeightKind::periodic}) {
    add("guided", all([&](Level& l) {
          l.weights = kind;
          l.guiding.d = 2.0;
        }));
    add("guided in stages", [&](Parameters& p) {
      for (Level& level : p.levels) level.weights = kind;
      p.levels[0].stages = {{.b = 9, .hops = 2}};
    });
  }
  add("manual", [](Parameters& p) {
    p.levels[0].endpoints = EndpointKind::manual;
    p.levels[0].points = {{{1.5, 4.0, 0.0}}, {{-1.5, 3.5, 0.3}}, {{0.0, 4.8, 0.0}}};
  });
  add("random endpoints", all([](Level& l) { l.endpoints = EndpointKind::random; }));
  add("shell", all([](Level& l) {
        l.endpoints = EndpointKind::shell;
        l.shell_thickness = 0.3;
      }));
  add("lattice", [](Parameters& p) { p.levels[0].layout = Layout::lattice; });
  add("threshold", all([](Level& l) { l.edges = EdgeKind::threshold; }));
  for (const int sectors : {6, 14}) add("sectors", all([&](Level& l) { l.sectors = sectors; }));
  add("refined", [](Parameters& p) {
    p.levels[0].nodes = 3000;
    p.refine = {.spheres = 4, .radius = 0.9};
  });
  add("pipe", [](Parameters& p) { p.widths = WidthModel::pipe; });
  return cases;
}

/// For each node the endpoint that its graph was made around; the root for those of level 1.
std::vector<std::uint32_t> bases_of(const Skeleton& tree) {
  std::vector<std::uint32_t> base(tree.node_count(), 0);
  for (std::uint32_t node = 1; node < tree.node_count(); ++node) {
    const std::uint32_t parent = tree.parent[node];
    base[node] = tree.level[parent] == tree.level[node] && parent != 0 ? base[parent] : parent;
  }
  return base;
}

struct Counts {
  double graphs = 1.0;
  double nodes = 0.0;
  double endpoints = 0.0;
};

/// What the rows add up to if every endpoint gets its graphs.
Counts expected_counts(const Parameters& parameters) {
  Counts counts;
  double graphs = 1.0;
  for (std::size_t i = 0; i < parameters.levels.size(); ++i) {
    const Level& row = parameters.levels[i];
    double b = row.endpoints == EndpointKind::manual ? static_cast<double>(row.points.size()) : row.b;
    for (const Stage& stage : row.stages) b += stage.b;
    if (i > 0) counts.graphs += graphs;
    counts.nodes += graphs * row.nodes;
    counts.endpoints += graphs * b;
    const bool is_around_all =
        i + 1 < parameters.levels.size() && parameters.levels[i + 1].around == Around::all;
    graphs = is_around_all ? counts.endpoints : graphs * b;
  }
  return counts;
}

PlannedTree planned(const Parameters& parameters) {
  const Surroundings surroundings(parameters);
  Stopwatch watch;
  const LevelPlan plan{.levels = parameters.levels,
                       .refine = parameters.refine,
                       .lifespan = parameters.lifespan,
                       .light = parameters.light,
                       .seed = parameters.seed};
  return plan_levels(plan, parameters.root, surroundings, {}, watch);
}

/// How many endpoints have the graph around each.
std::vector<std::size_t> children_of(const PlannedTree& tree) {
  const std::vector<std::uint32_t> base = bases_of(tree.skeleton);
  std::vector<std::size_t> children(tree.skeleton.node_count(), 0);
  for (std::size_t level = 1; level < tree.tips.size(); ++level) {
    for (const Tip& tip : tree.tips[level]) ++children[base[tip.node]];
  }
  return children;
}

std::vector<Vec3> sorted_positions(std::vector<Vec3> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  return points;
}

/// A point in the frame of a graph around an endpoint that grows along v_g: so far along it, so far aside.
bool is_within_graph(const Level& row, std::size_t level, const Vec3& from_base, const Vec3& v_g) {
  const double reach = subgraph_radius(row, level);
  const double along = glm::dot(from_base, v_g);
  const double across = glm::length(from_base - along * v_g);
  if (row.subgraph == SubgraphShape::custom) {
    return along > -1e-9 && along < reach + 1e-9 && across < 0.4 * reach + 1e-9;
  }
  return is_in_subgraph(row, reach, along, across, 1e-9);
}

}  // namespace

TEST_CASE("levels: two levels of 3 and 2 endpoints have 1 + 3 graphs and 3 + 6 endpoints") {
  Parameters parameters = tree_of(2);
  parameters.levels[0].b = 3;
  parameters.levels[1].b = 2;
  const RunResult result = run_with_layers(parameters);
  CHECK(reported(result, "all_graphs", "graphs") == 4.0);
  CHECK(reported(result, "all_graphs", "nodes") == 1500.0 + 3.0 * 70.0);
  CHECK(reported(result, "all_graphs", "endpoints") == 9.0);
  CHECK(reported(result, "graph", "nodes") == 1500.0);
  CHECK(layer<PointLayer>(result, "endpoints").values == std::vector<double>{1, 1, 1, 2, 2, 2, 2, 2, 2});
}

TEST_CASE("levels: whatever is chosen, the tree is sound, with all graphs, nodes and endpoints") {
  for (Case& c : cases()) {
    for (const std::uint64_t seed : {1, 2}) {
      INFO(c.name << ", " << c.parameters.levels.size() << " levels, seed " << seed);
      c.parameters.seed = seed;
      const Parameters& parameters = c.parameters;
      CHECK(Engine::check(parameters).empty());
      const RunResult result = run_with_layers(parameters);
      const Skeleton& tree = result.skeleton;
      CHECK(result.is_complete);
      CHECK(result.report.warnings.empty());
      CHECK(violations(tree).empty());
      CHECK(tree.root_count() == 1);
      CHECK(tree.position[0] == parameters.root);

      // Levels rise and widths do not, each by what its parent has.
      for (std::uint32_t node = 1; node < tree.node_count(); ++node) {
        const std::uint32_t parent = tree.parent[node];
        REQUIRE(tree.level[node] >= tree.level[parent]);
        REQUIRE(tree.diameter[node] <= tree.diameter[parent]);
        REQUIRE(tree.diameter[node] >= parameters.tip_diameter);
      }
      CHECK(*std::max_element(tree.level.begin(), tree.level.end()) == parameters.levels.size());

      // The endpoints are nodes, and all tips are endpoints.
      const auto& endpoints = layer<PointLayer>(result, "endpoints").points;
      CHECK(static_cast<double>(endpoints.size()) == reported(result, "all_graphs", "endpoints"));
      const auto is_less = [](const Vec3& a, const Vec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
      };
      const std::vector<Vec3> nodes = sorted_positions(tree.position);
      CHECK(std::adjacent_find(nodes.begin(), nodes.end()) == nodes.end());
      for (const Vec3& p : endpoints) REQUIRE(std::binary_search(nodes.begin(), nodes.end(), p, is_less));
      const std::vector<Vec3> ends = sorted_positions(endpoints);
      CHECK(std::adjacent_find(ends.begin(), ends.end()) == ends.end());
      std::vector<bool> is_parent(tree.node_count(), false);
      for (std::size_t node = 1; node < tree.node_count(); ++node) is_parent[tree.parent[node]] = true;
      for (std::size_t node = 1; node < tree.node_count(); ++node) {
        if (is_parent[node]) continue;
        REQUIRE(std::binary_search(ends.begin(), ends.end(), tree.position[node], is_less));
      }

      if (!c.has_all_graphs) continue;
      const Counts expected = expected_counts(parameters);
      CHECK(reported(result, "all_graphs", "graphs") == expected.graphs);
      CHECK(reported(result, "all_graphs", "endpoints") == expected.endpoints);
      if (c.name != "lattice") CHECK(reported(result, "all_graphs", "nodes") == expected.nodes);
    }
  }
}

TEST_CASE("levels: each graph's nodes are in its volume, about its endpoint along its v_g") {
  for (const Case& c : cases()) {
    const Parameters& parameters = c.parameters;
    if (parameters.lifespan.row_by == RowBy::lifespan) continue;
    INFO(c.name);
    const Skeleton tree = run_with_layers(parameters).skeleton;
    const std::vector<std::uint32_t> base = bases_of(tree);
    const Level& first = parameters.levels.front();
    const bool is_refined = parameters.refine.spheres > 0;
    const Solid solid(is_refined ? RefinedCrown(first, parameters.refine, parameters.root, 1).volume()
                                 : first.volume);
    std::size_t later = 0;
    for (std::uint32_t node = 1; node < tree.node_count(); ++node) {
      if (tree.level[node] == 1) {
        REQUIRE(solid.contains(tree.position[node]));
        continue;
      }
      ++later;
      const Level& row = parameters.levels[tree.level[node] - 1u];
      const Vec3 from_base = tree.position[node] - tree.position[base[node]];
      if (row.v_g == Orientation::random) {
        REQUIRE(glm::length(from_base) <= subgraph_radius(row, tree.level[node]) + 1e-9);
        continue;
      }
      Rng unused = Rng::stream(0, Stream::v_g, 0);
      const Vec3 outwards = glm::normalize(tree.position[base[node]] - tree.position[base[base[node]]]);
      const Vec3 v_g = subgraph_direction(row, parameters.light, outwards, unused);
      REQUIRE(is_within_graph(row, tree.level[node], from_base, v_g));
    }
    CHECK((later > 100 || parameters.levels.size() == 1));
  }
}

TEST_CASE("levels: no node is in an obstacle and no internode goes through one") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    for (const EdgeKind edges : {EdgeKind::yao, EdgeKind::threshold}) {
      Parameters parameters = tree_of(3, seed);
      for (Level& level : parameters.levels) level.edges = edges;
      const auto met = [](const Skeleton& tree) {
        std::size_t count = 0;
        for (std::size_t node = 1; node < tree.node_count(); ++node) {
          count += kBallAndWall.meets(tree.position[tree.parent[node]], tree.position[node]) ? 1 : 0;
        }
        return count;
      };
      CHECK(met(run_with_layers(parameters).skeleton) > 2);
      parameters.obstacles = kBallAndWall.obstacles();
      const RunResult result = run_with_layers(parameters);
      CHECK(met(result.skeleton) == 0);
      const auto& graph = layer<LineLayer>(result, "graph");
      for (const Vec3& node : graph.points) REQUIRE_FALSE(kBallAndWall.meets(node, node));
      for (const auto& [a, b] : graph.lines) {
        REQUIRE_FALSE(kBallAndWall.meets(graph.points[a], graph.points[b]));
      }
      // Level 1 has all it wants, in the room that is left.
      CHECK(reported(result, "graph", "nodes") == 1500.0);
      const auto& levels = layer<PointLayer>(result, "endpoints").values;
      CHECK(std::count(levels.begin(), levels.end(), 1.0) == 13);
      CHECK(std::count(levels.begin(), levels.end(), 3.0) > 100);
    }
  }
}

TEST_CASE("levels: paths keep away from where they cost more, and gather where they cost less") {
  const Volume place{.shape = Shape::sphere, .center = {0.6, 3.6, 0.0}, .radius = 1.0};
  const auto share_inside = [&](double factor) {
    std::size_t inside = 0;
    std::size_t all = 0;
    for (const std::uint64_t seed : {1, 2, 3}) {
      Parameters parameters = tree_of(1, seed);
      parameters.levels[0].b = 60;
      if (factor != 1.0) parameters.costs = {{place, factor}};
      const Skeleton tree = run_with_layers(parameters).skeleton;
      for (std::size_t node = 1; node < tree.node_count(); ++node) {
        inside += contains(place, 0.5 * (tree.position[node] + tree.position[tree.parent[node]])) ? 1 : 0;
      }
      all += tree.internode_count();
    }
    return static_cast<double>(inside) / static_cast<double>(all);
  };
  const double usual = share_inside(1.0);
  CHECK(share_inside(20.0) < 0.7 * usual);
  CHECK(share_inside(0.05) > 1.3 * usual);
}

TEST_CASE("levels: an endpoint without a lifespan bears nothing, each other one a graph of its row") {
  for (const RowBy row_by : {RowBy::level, RowBy::lifespan}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      INFO("row by " << static_cast<int>(row_by) << ", seed " << seed);
      Parameters parameters = tree_of(4, seed);
      parameters.lifespan = {.rule = LifespanRule::distribution, .p_stop = 0.3, .row_by = row_by};
      const PlannedTree tree = planned(parameters);
      const std::vector<std::size_t> children = children_of(tree);
      std::size_t graphs = 1;
      std::size_t by_lifespan[4] = {};
      for (std::size_t level = 1; level <= tree.tips.size(); ++level) {
        for (const Tip& tip : tree.tips[level - 1]) {
          const auto lifespan = static_cast<std::size_t>(tip.lifespan);
          if (level == 1) REQUIRE(lifespan == 3);
          if (level == 4) continue;  // none is dealt out where no level follows
          REQUIRE(lifespan <= 4 - level);
          ++by_lifespan[lifespan];
          graphs += lifespan > 0 ? 1 : 0;
          const std::size_t row = row_by == RowBy::level ? level : 4 - lifespan;
          const std::size_t b = lifespan == 0 ? 0 : static_cast<std::size_t>(parameters.levels[row].b);
          REQUIRE(children[tip.node] == b);
        }
      }
      CHECK(tree.counts.graphs == graphs);
      for (const std::size_t count : by_lifespan) CHECK(count > 0);
    }
  }
}

TEST_CASE("levels: by lifespan a graph is as large and as far-reaching as its row says") {
  Parameters parameters = tree_of(4);
  parameters.lifespan = {.rule = LifespanRule::distribution, .p_stop = 0.1, .row_by = RowBy::lifespan};
  const PlannedTree tree = planned(parameters);
  const std::vector<std::uint32_t> base = bases_of(tree.skeleton);
  std::vector<int> lifespan(tree.skeleton.node_count(), -1);
  for (const std::vector<Tip>& tips : tree.tips) {
    for (const Tip& tip : tips) lifespan[tip.node] = tip.lifespan;
  }
  std::size_t leaps = 0;
  for (std::uint32_t node = 1; node < tree.skeleton.node_count(); ++node) {
    if (tree.skeleton.level[node] == 1) continue;
    REQUIRE(lifespan[base[node]] > 0);
    const auto row = 4 - static_cast<std::size_t>(lifespan[base[node]]);
    leaps += row > tree.skeleton.level[node] - 1u ? 1 : 0;
    REQUIRE(glm::distance(tree.skeleton.position[node], tree.skeleton.position[base[node]]) <=
            subgraph_radius(parameters.levels[row], row + 1) + 1e-9);
  }
  CHECK(leaps > 20);  // graphs whose row is not that of their level
}

TEST_CASE("levels: towards the light endpoints live longer and bear more, their row's b times the factor") {
  Parameters parameters = tree_of(3);
  parameters.levels[0].b = 60;
  parameters.levels[1].b = 10;
  parameters.light = {.direction = {1.0, 0.0, 0.0}, .decrement_high = 2, .b_low = 0.0, .b_high = 2.0};
  const PlannedTree tree = planned(parameters);
  const std::vector<std::size_t> children = children_of(tree);
  std::size_t least = 99;
  std::size_t most = 0;
  for (const Tip& tip : tree.tips[0]) {
    const auto b = static_cast<std::size_t>(std::lround(10.0 * tip.b_factor));
    REQUIRE(children[tip.node] == (tip.lifespan > 0 ? b : 0));
    least = std::min(least, b);
    most = std::max(most, b);
  }
  CHECK(least == 0);
  CHECK(most >= 19);
  for (const Tip& a : tree.tips[0]) {
    for (const Tip& b : tree.tips[0]) {
      const double facing_a = glm::normalize(tree.skeleton.position[a.node] - a.origin).x;
      const double facing_b = glm::normalize(tree.skeleton.position[b.node] - b.origin).x;
      if (facing_a <= facing_b) continue;
      REQUIRE(a.lifespan >= b.lifespan);
      REQUIRE(a.b_factor >= b.b_factor);
    }
  }
}

TEST_CASE("levels: around all, the endpoints of every level before get a graph") {
  Parameters parameters = tree_of(3);
  parameters.levels[2].around = Around::all;
  const PlannedTree tree = planned(parameters);
  CHECK(tree.counts.graphs == 1 + 13 + 13 + 13 * 5);
  const std::vector<std::size_t> children = children_of(tree);
  for (const Tip& tip : tree.tips[0]) CHECK(children[tip.node] == 5 + 3);
  for (const Tip& tip : tree.tips[1]) CHECK(children[tip.node] == 3);
}

TEST_CASE("levels: endpoints of a later shell are near its curved face") {
  Parameters parameters = tree_of(2);
  parameters.levels[1].endpoints = EndpointKind::shell;
  parameters.levels[1].shell_thickness = 0.25;
  const PlannedTree tree = planned(parameters);
  for (const Tip& tip : tree.tips[1]) {
    const double from_base = glm::distance(tree.skeleton.position[tip.node], tip.origin);
    REQUIRE(from_base >= subgraph_radius(parameters.levels[1], 2) - 0.25 - 1e-9);
  }
}

TEST_CASE("levels: no two graphs are alike, and the seed changes those of every level") {
  // A lattice and endpoints by hand: level 1 is the same for every seed.
  Parameters parameters = tree_of(2);
  parameters.levels[0].layout = Layout::lattice;
  parameters.levels[0].endpoints = EndpointKind::manual;
  parameters.levels[0].points = {{{1.5, 4.0, 0.0}}, {{-1.5, 3.5, 0.3}}};
  const auto reaches_of = [&](std::uint64_t seed) {
    parameters.seed = seed;
    const PlannedTree tree = planned(parameters);
    std::vector<double> reaches;
    for (const Tip& tip : tree.tips[1]) {
      reaches.push_back(glm::distance(tree.skeleton.position[tip.node], tip.origin));
    }
    return reaches;
  };
  const std::vector<double> once = reaches_of(1);
  const std::vector<double> again = reaches_of(2);
  REQUIRE(once.size() == 10);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(std::abs(once[i] - once[i + 5]) > 1e-6);
    CHECK(std::abs(once[i] - again[i]) > 1e-6);
  }
}

TEST_CASE("levels: manual endpoints are where the config says") {
  Parameters parameters = tree_of(2);
  parameters.levels[0].endpoints = EndpointKind::manual;
  parameters.levels[0].points = {{{1.5, 4.0, 0.0}}, {{-1.5, 3.5, 0.3}}, {{0.0, 9.0, 0.0}}};
  const auto tips = [&] { return layer<PointLayer>(run_with_layers(parameters), "endpoints").points; };
  const std::vector<Vec3> points = tips();
  CHECK(points[0] == Vec3(1.5, 4.0, 0.0));
  CHECK(points[1] == Vec3(-1.5, 3.5, 0.3));
  CHECK(glm::distance(points[2], {0.0, 5.0, 0.0}) < 0.5);  // outside: the nearest node, at the very top
  CHECK(points.size() == 3 + 3 * 5);
  // On a lattice, too, the nearest node stands for each.
  parameters.levels[0].layout = Layout::lattice;
  CHECK(glm::distance(tips()[0], {1.5, 4.0, 0.0}) < 0.25);
}

TEST_CASE("levels: on a lattice edges of one spacing join all neighbours") {
  Parameters parameters = tree_of(1);
  Level& level = parameters.levels.front();
  level.layout = Layout::lattice;
  level.max_edge = 1.0;
  level.sectors = 6;
  for (const Place& place : places()) {
    level.volume = place.volume;
    parameters.root = place.root;
    parameters.unreachable = Unreachable::warn;  // corners of a lattice may hang on a diagonal alone
    for (const EdgeKind kind : {EdgeKind::yao, EdgeKind::threshold}) {
      INFO(place.name << ", kind " << static_cast<int>(kind));
      level.edges = kind;
      const auto result = run_with_layers(parameters);
      const auto& graph = layer<LineLayer>(result, "graph");
      double spacing = 1e9;
      for (const Vec3& node : graph.points) {
        if (node != graph.points[0]) spacing = std::min(spacing, glm::distance(node, graph.points[0]));
      }
      const Solid solid(level.volume);
      std::size_t neighbours = 0;
      for (std::size_t i = 0; i < graph.points.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const Vec3 d = graph.points[i] - graph.points[j];
          if (glm::length(d) > 1.01 * spacing) continue;
          const auto is_inside = [&](double share) { return solid.contains(graph.points[j] + share * d); };
          neighbours += is_inside(0.25) && is_inside(0.5) && is_inside(0.75) ? 1 : 0;
        }
      }
      CHECK(graph.lines.size() == neighbours);
    }
  }
}

TEST_CASE("levels: the first k are those of a run of k levels") {
  Parameters parameters = tree_of(4);
  parameters.levels[2].around = Around::all;
  const Skeleton tree = run_with_layers(parameters).skeleton;
  for (const int steps : {1, 2, 3}) {
    parameters.steps = steps;
    const Skeleton start = run_with_layers(parameters).skeleton;
    CHECK(*std::max_element(start.level.begin(), start.level.end()) == steps);
    REQUIRE(start.node_count() < tree.node_count());
    CHECK(std::equal(start.position.begin(), start.position.end(), tree.position.begin()));
    CHECK(std::equal(start.parent.begin(), start.parent.end(), tree.parent.begin()));
    CHECK(tree.level[start.node_count()] == steps + 1);
  }
}

TEST_CASE("levels: the seed changes every tree, the number of threads none") {
  for (Case& c : cases()) {
    INFO(c.name);
    const RunResult tree = run_with_layers(c.parameters);
    for (const int threads : {1, 2, 3}) {
      const ThreadLimit limit(threads);
      const RunResult again = run_with_layers(c.parameters);
      CHECK(is_same(tree.skeleton, again.skeleton));
      CHECK(layer<PointLayer>(tree, "endpoints").points == layer<PointLayer>(again, "endpoints").points);
    }
    c.parameters.seed = 2;
    CHECK(tree.skeleton.position != run_with_layers(c.parameters).skeleton.position);
  }
}

TEST_CASE("levels: a stop request at any report leaves the levels that are whole") {
  const Parameters parameters = tree_of(3);
  const Skeleton whole = run_with_layers(parameters).skeleton;
  std::size_t reports = 0;
  RunContext counting;
  counting.progress = [&](const Progress&) { ++reports; };
  Engine::run(parameters, counting);
  REQUIRE(reports >= 6);  // nodes, graph, paths, two later levels, tree

  std::size_t ends[4] = {};  // of each level's nodes
  for (std::size_t node = 0; node < whole.node_count(); ++node) ends[whole.level[node]] = node + 1;
  ends[0] = 1;
  std::set<std::size_t> found;
  for (std::size_t wanted = 1; wanted <= reports; ++wanted) {
    std::stop_source stop;
    std::size_t seen = 0;
    std::string stage;
    RunContext context;
    context.stop = stop.get_token();
    context.progress = [&](const Progress& now) {
      if (++seen != wanted) return;
      stage = now.stage;
      stop.request_stop();
    };
    const RunResult result = Engine::run(parameters, context);
    INFO("report " << wanted << ", " << stage);
    CHECK(result.is_complete == (stage == "tree"));
    CHECK(violations(result.skeleton).empty());
    const std::size_t level = stage == "level 2" ? 1 : stage == "level 3" ? 2 : stage == "tree" ? 3 : 0;
    CHECK(result.skeleton.node_count() == ends[level]);
    CHECK(
        std::equal(result.skeleton.position.begin(), result.skeleton.position.end(), whole.position.begin()));
    CHECK(reported(result, "all_graphs", "graphs") == (level == 0   ? 0
                                                       : level == 1 ? 1
                                                       : level == 2 ? 14
                                                                    : 79));
    found.insert(level);
  }
  CHECK(found.size() == 4);
}
