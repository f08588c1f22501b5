// Shoots, phyllotaxis and shedding.

#include "growth/shoots.h"

#include "growth/phyllotaxis.h"
#include "growth/shedding.h"
#include "growth/simulation.h"
#include "tests/catch.h"
#include "tests/growth/runs.h"

using namespace ramify;
using namespace ramify::growth;
using namespace ramify::test;

namespace {

/// A seedling after one step with this vigour at its only bud.
Plant grown(const Parameters& parameters, double vigour) {
  Plant plant = seedling(parameters);
  const ShadowGrid shadow({}, parameters.voxel_edge());
  extend_shoots(plant, {vigour}, parameters, shadow, 1);
  return plant;
}

std::size_t axillary_buds(const Plant& plant) {
  std::size_t count = 0;
  for (const Bud& bud : plant.buds) count += !bud.is_terminal;
  return count;
}

}  // namespace

TEST_CASE("shoots: a bud with v < 1 rests, one a rounding error below grows") {
  CHECK(grown(Parameters{}, 0.999).internode_count() == 0);
  CHECK(grown(Parameters{}, 0.999).buds.size() == 1);
  CHECK(grown(Parameters{}, 1.0 - 1e-10).internode_count() == 1);
}

TEST_CASE("shoots: v makes floor(v) metamers of length v / floor(v)") {
  Parameters parameters;
  parameters.internode_length = 0.1;
  parameters.max_metamers = 0;
  const Plant plant = grown(parameters, 3.6);
  REQUIRE(plant.internode_count() == 3);
  for (std::size_t i = 1; i <= 3; ++i) {
    CHECK(std::abs(glm::length(plant.position[i] - plant.position[i - 1]) - 0.12) < 1e-12);
  }
}

TEST_CASE("shoots: what is above the cap is lost, and the cap may be a fraction") {
  Parameters parameters;
  parameters.internode_length = 1.0;
  parameters.max_metamers = 2.5;
  const Plant plant = grown(parameters, 100.0);
  REQUIRE(plant.internode_count() == 2);
  CHECK(std::abs(glm::length(plant.position[1]) - 1.25) < 1e-12);
  CHECK(planned_metamers({100.0, 0.5, 1.0}, parameters, 1) == 3.0);
}

TEST_CASE("shoots: the last node bears both buds, or the terminal alone until it grows on") {
  Parameters parameters;
  parameters.tip_bud = TipBud::both;
  CHECK(axillary_buds(grown(parameters, 3.0)) == 3);
  parameters.tip_bud = TipBud::terminal;
  CHECK(axillary_buds(grown(parameters, 3.0)) == 3);  // the root's, and those of two inner nodes

  Plant plant = grown(parameters, 3.0);
  CHECK(plant.buds.size() == 4);
  std::vector<double> vigour(plant.buds.size(), 0.0);
  vigour.back() = 1.0;
  CHECK(plant.buds.back().is_terminal);
  extend_shoots(plant, vigour, parameters, ShadowGrid({}, 0.1), 2);
  CHECK(axillary_buds(plant) == 4);
}

TEST_CASE("shoots: without weights a shoot goes on in its default direction") {
  Parameters parameters;
  parameters.w_default = 0.0;
  parameters.w_optimal = 0.0;
  const Plant plant = grown(parameters, 4.0);
  CHECK(glm::length(plant.position.back() - Vec3(0, 0.4, 0)) < 1e-12);
}

TEST_CASE("shoots: nothing grows below ground, a bud blocked at once dies and later it stops") {
  Parameters parameters;
  parameters.tropism["down"] = {.weight = 10.0, .direction = Vec3(0, -2, 0)};
  parameters.w_optimal = 0.0;
  Plant plant = grown(parameters, 3.0);
  CHECK(plant.internode_count() == 0);
  CHECK(plant.buds.empty());

  parameters.ground_y = -0.25;
  plant = grown(parameters, 4.0);
  CHECK(plant.internode_count() == 2);
  CHECK(plant.buds.back().is_terminal);

  parameters.ground = false;
  CHECK(grown(parameters, 4.0).internode_count() == 4);
}

TEST_CASE("phyllotaxis: spiral buds stand at the branching angle, 137.5 degrees apart") {
  Parameters parameters;
  parameters.branching_angle_deg = 50.0;
  Axis axis;
  axis.direction = glm::normalize(Vec3(1, 2, 3));
  axis.reference = any_perpendicular(axis.direction);
  Vec3 previous(0.0);
  for (std::uint32_t rank = 0; rank < 10; ++rank) {
    const Vec3 bud = axillary_direction(parameters, axis, 0, rank, 1);
    CHECK(std::abs(glm::length(bud) - 1.0) < 1e-12);
    CHECK(std::abs(degrees(std::acos(glm::dot(bud, axis.direction))) - 50.0) < 1e-9);
    const Vec3 outwards = glm::normalize(bud - axis.direction * glm::dot(bud, axis.direction));
    if (rank > 0) CHECK(std::abs(degrees(std::acos(glm::dot(outwards, previous))) - 137.5) < 1e-6);
    previous = outwards;
  }
}

TEST_CASE("phyllotaxis: planar buds fall left and right of their axis equally often") {
  Parameters parameters;
  parameters.phyllotaxis = Phyllotaxis::planar_random;
  parameters.branching_angle_deg = 45.0;
  Axis axis;
  int left = 0;
  for (std::uint32_t rank = 0; rank < 1000; ++rank) {
    const Vec3 bud = axillary_direction(parameters, axis, 3, rank, 1);
    CHECK(std::abs(bud.z) < 1e-12);
    CHECK(std::abs(bud.y - std::sqrt(0.5)) < 1e-12);
    left += bud.x < 0;
  }
  CHECK(std::abs(left - 500) < 80);  // 5 standard deviations
  axis.direction = Vec3(0, 0, 1);
  CHECK(std::abs(axillary_direction(parameters, axis, 3, 0, 1).z - std::sqrt(0.5)) < 1e-12);
}

TEST_CASE("shedding: an axis in the shade goes with all that grows on it, the trunk never") {
  Parameters parameters = growth_parameters("p09-fig7-50", {"growth.shed_threshold=0.4"});
  Simulation simulation(parameters);
  for (int i = 0; i < 12; ++i) REQUIRE(simulation.advance());
  const Plant& plant = simulation.plant();
  std::size_t shed = 0;
  for (std::size_t node = 1; node < plant.node_count(); ++node) {
    const Axis& axis = plant.axes[plant.axis[node]];
    CHECK(axis.is_shed == (plant.shed_step[node] != kAlive));
    if (plant.axes[plant.axis[plant.parent[node]]].is_shed) CHECK(axis.is_shed);
    shed += axis.is_shed;
  }
  CHECK(shed > 100);
  CHECK_FALSE(plant.axes[0].is_shed);
  for (const Bud& bud : plant.buds) CHECK_FALSE(plant.axes[bud.axis].is_shed);
}

TEST_CASE(
    "shedding: an axis is judged by light an internode, not in the step that makes it, not before its time") {
  Parameters parameters;
  parameters.shed_threshold = 0.5;
  Plant plant = seedling(parameters);
  plant.axes.push_back({.base = 0, .first = 1, .node_count = 2, .birth_step = 1, .order = 1});
  for (std::uint32_t parent : {0u, 1u}) {
    plant.position.push_back(Vec3(0.0));
    plant.parent.push_back(parent);
    plant.axis.push_back(1);
    plant.birth_step.push_back(1);
    plant.shed_step.push_back(kAlive);
  }
  plant.buds.push_back({.node = 2, .axis = 1, .is_terminal = true});
  LightSums sums;
  sum_light(plant, {1.0, 1.0}, sums);
  CHECK(shaded_axes(plant, sums, parameters, 2).empty());  // 1 / 2 is not below
  sum_light(plant, {1.0, 0.99}, sums);
  CHECK(shaded_axes(plant, sums, parameters, 2) == std::vector<std::uint32_t>{1});
  parameters.shed_after = 2;
  CHECK(shaded_axes(plant, sums, parameters, 2).empty());
  CHECK(shaded_axes(plant, sums, parameters, 3).size() == 1);
}
