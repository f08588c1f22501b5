#include "pathplan/parameter_check.h"

#include <cmath>
#include <functional>

#include "common/base/errors.h"
#include "pathplan/engine.h"
#include "tests/catch.h"

using namespace ramify;
using namespace ramify::pathplan;

namespace {

/// What check() says of the default parameters after a change.
std::string problem_after(const std::function<void(Parameters&, Level&)>& change) {
  Parameters parameters;
  change(parameters, parameters.levels.front());
  try {
    if (!Engine::check(parameters).empty()) return "a warning";
  } catch (const ConfigError& error) {
    CHECK(error.where().empty());
    return error.what();
  }
  return {};
}

void check_table(const Table& table, void* owner, int depth) {
  for (const FieldRow& row : table) {
    INFO(row.key);
    CHECK_FALSE(row.info.help.empty());
    CHECK(row.info.help.find('\n') == std::string::npos);
    void* member = row.member(owner);
    const auto is_in_range = [&](double value) {
      CHECK(std::isfinite(row.info.min));
      CHECK(std::isfinite(row.info.max));
      return row.info.min <= value && value <= row.info.max &&
             (!row.info.is_above_min || value > row.info.min);
    };
    if (row.kind == FieldKind::number) CHECK(is_in_range(*static_cast<double*>(member)));
    if (row.kind == FieldKind::integer) CHECK(is_in_range(*static_cast<int*>(member)));
    if (row.kind == FieldKind::vector) {
      for (int i = 0; i < 3; ++i) CHECK(is_in_range((*static_cast<Vec3*>(member))[i]));
    }
    if (row.kind == FieldKind::choice) CHECK(row.choice(member) < static_cast<int>(row.info.choices.size()));
    if (row.kind == FieldKind::group) check_table(row.child(), member, depth + 1);
    if (row.kind == FieldKind::list) {
      for (std::size_t i = 0; i < row.size(member); ++i)
        check_table(row.child(), row.item(member, i), depth + 1);
    }
  }
}

}  // namespace

TEST_CASE("pathplan parameters: every row has help, every number a finite range that holds its default") {
  Parameters parameters;
  check_table(Parameters::fields(), &parameters, 0);
}

TEST_CASE("pathplan parameters: the defaults are sound, and a level added to them starts as the one before") {
  CHECK(problem_after([](Parameters&, Level&) {}).empty());
  Parameters parameters;
  parameters.levels.front().b = 77;
  for (const FieldRow& row : Parameters::fields()) {
    if (row.key == "levels") row.append(row.member(&parameters));
    CHECK(row.info.is_top_level == (row.key == "seed" || row.key == "steps"));
  }
  REQUIRE(parameters.levels.size() == 2);
  CHECK(parameters.levels.back().b == 77);
}

TEST_CASE("pathplan parameters: steps are levels, and there must be as many") {
  CHECK(problem_after([](Parameters& p, Level&) { p.steps = 3; }) == "steps: 3 (there is 1 level)");
  CHECK(problem_after([](Parameters& p, Level&) {
          p.levels.resize(2);
          p.steps = 3;
        }) == "steps: 3 (there are 2 levels)");
  CHECK(problem_after([](Parameters& p, Level&) { p.levels.clear(); }) ==
        "levels: none (at least one level)");
  CHECK(problem_after([](Parameters& p, Level&) {
          p.levels.resize(2);
          p.levels.back().sectors = 7;  // not planned, so not looked at
          p.steps = 1;
        }).empty());
}

TEST_CASE("pathplan parameters: what cannot be is named with its key and what is allowed") {
  CHECK(problem_after([](Parameters&, Level& l) { l.sectors = 7; }) == "levels.1.sectors: 7 (6, 8 or 14)");
  CHECK(problem_after([](Parameters&, Level& l) { l.weight_low = 2.0; }) ==
        "levels.1.weight_low: 2 is more than weight_high, 1 (at most as much)");
  CHECK(problem_after([](Parameters&, Level& l) { l.b = l.nodes; }) ==
        "levels.1.b: 30000 endpoints of 30000 nodes (at most 29999: the root is none)");
  CHECK(problem_after([](Parameters&, Level& l) { l.b = l.nodes - 1; }).empty());
  CHECK(problem_after([](Parameters& p, Level&) { p.tip_diameter = 0.75; }) ==
        "tip_diameter: 0.75 m is more than trunk_diameter, 0.5 m (at most as much)");
  CHECK(problem_after([](Parameters& p, Level&) {
          p.root = {0.0, -0.5, 0.0};
        }) == "root: [0, -0.5, 0] is outside the volume of level 1 (inside or on its surface)");
}

TEST_CASE("pathplan parameters: volumes and regions are looked into") {
  CHECK(problem_after([](Parameters&, Level& l) { l.volume.parts.clear(); }) ==
        "levels.1.volume: a union without parts (at least one part)");
  CHECK(problem_after([](Parameters&, Level& l) {
          l.volume.parts[0].direction = {0.0, 0.0, 0.0};
        }) ==
        "levels.1.volume.parts.1.direction: its length is 0 (any other length; only where it points counts)");
  const auto move_region = [](Level& l) {
    l.region = {.shape = Shape::sphere, .center = {50.0, 0.0, 0.0}, .radius = 1.0};
  };
  for (const EndpointKind kind : {EndpointKind::region, EndpointKind::shell}) {
    CHECK(problem_after([&](Parameters&, Level& l) {
            l.endpoints = kind;
            move_region(l);
          }) == "levels.1.region: it has nothing in common with the level's volume (they must overlap)");
  }
  CHECK(problem_after([&](Parameters&, Level& l) {
          l.endpoints = EndpointKind::random;  // reads no region
          move_region(l);
        }).empty());
}

TEST_CASE("pathplan parameters: a spacing stands for a number of nodes") {
  const std::string problem = problem_after([](Parameters&, Level& l) { l.spacing = 0.001; });
  CHECK(problem.find("levels.1.spacing: 0.001 m makes ") == 0);
  CHECK(problem.find(" nodes in this volume (at most 10000000)") != std::string::npos);
  CHECK(problem_after([](Parameters&, Level& l) {
          l.spacing = 2.0;
          l.b = 50;
        }).find("levels.1.b: 50 endpoints of ") == 0);
  CHECK(problem_after([](Parameters&, Level& l) { l.spacing = 0.2; }).empty());
}

TEST_CASE("pathplan parameters: later levels are looked into with their own keys") {
  const auto problem_of = [](const std::function<void(Level&)>& change) {
    return problem_after([&](Parameters& p, Level& l) {
      l.b = 20;
      l.nodes = 2000;
      p.levels.push_back(Level(l));
      change(p.levels.back());
    });
  };
  CHECK(problem_of([](Level&) {}).empty());
  CHECK(problem_of([](Level& l) { l.sectors = 9; }) == "levels.2.sectors: 9 (6, 8 or 14)");
  CHECK(problem_of([](Level& l) { l.endpoints = EndpointKind::manual; }) ==
        "levels.2.endpoints: manual, after level 1 (random | shell | region)");
  CHECK(problem_of([](Level& l) {
          l.v_g = Orientation::fixed;
          l.v_g_direction = Vec3(0.0);
        }) == "levels.2.v_g_direction: its length is 0 (any other length; only where it points counts)");
  CHECK(problem_of([](Level& l) { l.v_g_direction = Vec3(0.0); }).empty());  // not read
  for (const SubgraphShape shape :
       {SubgraphShape::cone, SubgraphShape::inverted_cone, SubgraphShape::ellipsoid}) {
    const auto with_alpha = [&](double alpha_deg) {
      return problem_of([&](Level& l) {
        l.subgraph = shape;
        l.alpha_deg = alpha_deg;
      });
    };
    CHECK(with_alpha(90.0) == "levels.2.alpha_deg: 90 of a cone or ellipsoid (less than 90)");
    CHECK(with_alpha(89.0).empty());
  }
  CHECK(problem_of([](Level& l) { l.alpha_deg = 180.0; }).empty());  // of a sphere
  const auto with_custom = [&](const Volume& volume) {
    return problem_of([&](Level& l) {
      l.subgraph = SubgraphShape::custom;
      l.volume = volume;
    });
  };
  CHECK(with_custom({.shape = Shape::sphere}).empty());
  CHECK(with_custom({.shape = Shape::sphere, .center = {0.0, 1.5, 0.0}}) ==
        "levels.2.volume: the origin is outside (a custom subgraph grows from there along +Y)");
  CHECK(with_custom({.shape = Shape::union_of}) ==
        "levels.2.volume: a union without parts (at least one part)");
  CHECK(problem_of([](Level& l) { l.b = 2000; }) ==
        "levels.2.b: 2000 endpoints of 2000 nodes (at most 1999: the root is none)");
}

TEST_CASE("pathplan parameters: the edges of threshold graphs have a limit") {
  CHECK(problem_after([](Parameters&, Level& l) {
          l.edges = EdgeKind::threshold;
          l.max_edge = 20.0;
        }) ==
        "levels.1.max_edge: 20 spacings make about 212 million edges with edges = \"threshold\" (at most 50 "
        "million)");
  CHECK(problem_after([](Parameters&, Level& l) {
          l.edges = EdgeKind::threshold;
          l.max_edge = 12.0;
        }).empty());
  CHECK(problem_after([](Parameters&, Level& l) { l.max_edge = 100.0; }).empty());
}

TEST_CASE("pathplan parameters: all graphs of a level together have a limit") {
  const auto problem_of = [](Around around, int nodes) {
    return problem_after([&](Parameters& p, Level& l) {
      l.b = 100;
      l.nodes = 2000;
      p.levels.assign(3, Level(l));
      p.levels[1].b = 50;
      p.levels[2].around = around;
      p.levels[2].nodes = nodes;
      p.levels[2].b = 5;
    });
  };
  // 100 * 50 graphs; around all 100 more.
  CHECK(problem_of(Around::last, 2000).empty());
  CHECK(
      problem_of(Around::last, 2001) ==
      "levels.3.nodes: 5000 graphs of 2001 nodes make 10005000 (at most 10000000; each endpoint of the level "
      "before gets a graph)");
  CHECK(problem_of(Around::all, 1960).empty());
  CHECK(
      problem_of(Around::all, 2000) ==
      "levels.3.nodes: 5100 graphs of 2000 nodes make 10200000 (at most 10000000; each endpoint of the level "
      "before gets a graph)");
  // Stages are endpoints, too.
  CHECK(
      problem_after([](Parameters& p, Level& l) {
        l.nodes = 4000;
        p.levels.push_back(Level(l));
        p.levels[0].stages = {{.b = 2500, .hops = 2}};
      }) ==
      "levels.2.nodes: 2900 graphs of 4000 nodes make 11600000 (at most 10000000; each endpoint of the level "
      "before gets a graph)");
}

TEST_CASE("pathplan parameters: endpoints of stages and by the light's factor count") {
  CHECK(problem_after([](Parameters&, Level& l) {
          l.nodes = 500;
          l.b = 300;
          l.stages = {{.b = 150}, {.b = 50}};
        }) == "levels.1.b: 500 endpoints of 500 nodes (at most 499: the root is none)");
  CHECK(problem_after([](Parameters&, Level& l) {
          l.nodes = 500;
          l.b = 300;
          l.stages = {{.b = 199}};
        }).empty());
  const auto with_light = [](double b_high) {
    return problem_after([&](Parameters& p, Level& l) {
      l.nodes = 500;
      l.b = 300;
      p.levels.push_back(Level(l));
      p.light.b_high = b_high;
    });
  };
  CHECK(with_light(1.6).empty());
  CHECK(with_light(2.0) == "levels.2.b: 600 endpoints of 500 nodes (at most 499: the root is none)");
}

TEST_CASE("pathplan parameters: manual endpoints need points, and each of them a node") {
  CHECK(problem_after([](Parameters&, Level& l) { l.endpoints = EndpointKind::manual; }) ==
        "levels.1.points: none, with endpoints = \"manual\" (at least one)");
  CHECK(problem_after([](Parameters&, Level& l) {
          l.endpoints = EndpointKind::manual;
          l.points.resize(3);
          l.nodes = 3;
        }) == "levels.1.b: 3 endpoints of 3 nodes (at most 2: the root is none)");
  CHECK(problem_after([](Parameters&, Level& l) {
          l.endpoints = EndpointKind::manual;
          l.points.resize(1);
          l.nodes = 3;
          l.b = 1000;  // not read
        }).empty());
}

TEST_CASE("pathplan parameters: what the light deals out is in order, and comes from somewhere") {
  CHECK(problem_after([](Parameters& p, Level&) { p.light.direction = Vec3(0.0); }) ==
        "light.direction: its length is 0 (any other length; only where it points counts)");
  CHECK(problem_after([](Parameters& p, Level&) {
          p.light.decrement_low = 3;
          p.light.decrement_high = 2;
        }) == "light.decrement_low: 3 is more than decrement_high, 2 (at most as much)");
  CHECK(problem_after([](Parameters& p, Level&) { p.light.b_low = 1.25; }) ==
        "light.b_low: 1.25 is more than b_high, 1 (at most as much)");
  const auto by_distribution = [](int decrement_high) {
    return problem_after([&](Parameters& p, Level&) {
      p.lifespan.rule = LifespanRule::distribution;
      p.light.decrement_high = decrement_high;
    });
  };
  CHECK(by_distribution(1).empty());
  CHECK(by_distribution(2) ==
        "light.decrement_high: 2, but lifespan.rule = \"distribution\" draws the decrements (1, or the rule "
        "\"fixed\")");
}

TEST_CASE("pathplan parameters: obstacles stand beside the root, and volumes in the world have a size") {
  const Volume ball{.shape = Shape::sphere, .center = {3.0, 1.0, 0.0}, .radius = 0.5};
  CHECK(problem_after([&](Parameters& p, Level&) {
          p.obstacles = {{ball}};
          p.costs = {{ball, 2.0}};
        }).empty());
  CHECK(problem_after([&](Parameters& p, Level&) {
          p.obstacles = {{ball}, {{.shape = Shape::sphere}}};
        }) == "obstacles.2.volume: the tree's root is inside (obstacles stand beside it)");
  CHECK(problem_after([&](Parameters& p, Level&) { p.obstacles = {{{.shape = Shape::union_of}}}; }) ==
        "obstacles.1.volume: a union without parts (at least one part)");
  CHECK(problem_after([&](Parameters& p, Level&) {
          p.costs = {{ball, 2.0}, {{.shape = Shape::union_of}, 2.0}};
        }) == "costs.2.volume: a union without parts (at least one part)");
}

TEST_CASE("pathplan parameters: a refined crown has no manual endpoints") {
  CHECK(problem_after([](Parameters& p, Level& l) {
          p.refine.spheres = 5;
          l.endpoints = EndpointKind::manual;
          l.points.resize(2);
        }) ==
        "refine.spheres: 5 with manual endpoints (0, or endpoints in the spheres: random, shell or region)");
  CHECK(problem_after([](Parameters& p, Level&) { p.refine.spheres = 5; }).empty());
}

TEST_CASE("pathplan parameters: roots are levels of their own, about the tree's root") {
  const auto with_roots = [](const std::function<void(Level&)>& change) {
    return problem_after([&](Parameters& p, Level& l) {
      p.roots = {l};
      p.roots.front().volume = {.shape = Shape::hemisphere, .radius = 2.0, .direction = {0.0, -1.0, 0.0}};
      change(p.roots.front());
    });
  };
  CHECK(with_roots([](Level&) {}).empty());
  CHECK(with_roots([](Level& l) { l.sectors = 7; }) == "roots.1.sectors: 7 (6, 8 or 14)");
  CHECK(with_roots([](Level& l) { l.b = l.nodes; }) ==
        "roots.1.b: 30000 endpoints of 30000 nodes (at most 29999: the root is none)");
  CHECK(with_roots([](Level& l) {
          l.volume.center = {0.0, -1.0, 0.0};
        }) == "root: [0, 0, 0] is outside the volume of the roots (inside or on its surface)");
}
