#include "growth/parameter_check.h"

#include <algorithm>

#include "common/base/errors.h"
#include "common/config/schedule.h"
#include "tests/catch.h"
#include "tests/growth/runs.h"

using namespace ramify;
using namespace ramify::test;

namespace {

/// The message with which a preset with these values is refused; empty if it is not.
std::string refusal(const std::vector<std::string>& assignments) {
  try {
    growth_parameters("p09-fig7-50", assignments);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("growth parameters: what no range can say is refused with key, value and what is allowed") {
  const std::string ball = R"(volume = {shape = "sphere", center = [0.0, 0.2, 0.0], radius = 1.0})";
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"growth.tropism.up.direction=[0, 0, 0]"},
       "--set: growth.tropism.up.direction: [0, 0, 0] points nowhere (any other vector)"},
      {{"growth.tropism.up.min_order=3", "growth.tropism.up.max_order=2"},
       "--set: growth.tropism.up.min_order: 3 is more than max_order (at most 2)"},
      {{"growth.w_min=2"}, "--set: growth.w_min: 2 is more than w_max at step 0 (at most 1)"},
      {{"growth.sun_direction=[0, 0, 0]"},
       "--set: growth.sun_direction: [0, 0, 0] points nowhere (any other vector)"},
      {{"growth.sun_direction=[3, 1, 0]"},
       "--set: growth.sun_direction: the light is 18.4 degrees high (at least 20)"},
      {{"growth.obstacles=[{" + ball + "}]"},
       "--set: growth.obstacles.1: a tree's root stands in obstacle 1 (beside it)"},
      {{"growth.obstacles=[{" + ball + "}]",
        "growth.trees=[{position = [5.0, 0.0, 0.0]}, {position = [0.5, 0.0, 0.0]}]"},
       "--set: growth.trees.2.position: a tree's root stands in obstacle 1 (beside it)"},
      {{"growth.trees=[{position = [5.0, -1.0, 0.0]}]"},
       "--set: growth.trees.1.position: its root is below ground (y at least 0)"},
      {{"growth.trees=[{position = [5.0, 0.0, 0.0], w_min = 3}]"},
       "--set: growth.trees.1.w_min: 3 is more than w_max at step 0 (at most 1)"},
      {{R"(growth.obstacles=[{shadow = 1.0, volume = {shape = "sphere", center = [0.0, 60.0, 0.0], radius = 40.0}}])"},
       "--set: growth.obstacles.1.shadow: shadow in a box of 5.12e+08 voxels (at most 5e+07: make it "
       "smaller, or "
       "voxel_size larger)"},
      {{"growth.environment=space", "growth.markers.density=1e9"},
       "--set: growth.markers.density: 8.24e+10 markers in the volume (at most 5e+07)"},
      {{R"(growth.prune=[{volume = {shape = "union"}}])"},
       "--set: growth.prune.1.volume: a union without parts (at least one part)"},
  };
  for (const auto& [assignments, message] : cases) {
    INFO(assignments.front());
    CHECK(refusal(assignments) == message);
  }
}

TEST_CASE("growth parameters: markers are only looked at where they count") {
  CHECK(refusal({"growth.markers.density=1e9"}).empty());
}

TEST_CASE("growth parameters: a tree that will not even begin is a warning, tree by tree") {
  growth::Parameters parameters = growth_parameters("p09-fig7-50", {"growth.alpha=0.5"});
  REQUIRE(growth::check_parameters(parameters).size() == 1);
  CHECK(growth::check_parameters(parameters)[0].find("growth.alpha: the tree stays a seed") == 0);
  parameters = growth_parameters(
      "p09-fig7-50",
      {"growth.trees=[{position = [0.0, 0.0, 0.0]}, {position = [9.0, 0.0, 0.0], alpha = 0.2}]"});
  REQUIRE(growth::check_parameters(parameters).size() == 1);
  CHECK(growth::check_parameters(parameters)[0].find("growth.trees.2.alpha: ") == 0);
}
