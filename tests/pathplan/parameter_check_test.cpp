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
