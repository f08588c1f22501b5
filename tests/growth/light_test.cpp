#include "growth/environment_light.h"

#include "tests/catch.h"
#include "tests/growth/runs.h"

using namespace ramify;
using namespace ramify::growth;
using namespace ramify::test;

namespace {

Parameters parameters_with(double r, double theta_deg, Tie tie) {
  Parameters parameters;
  parameters.r = r;
  parameters.theta_deg = theta_deg;
  parameters.tie = tie;
  return parameters;
}

double distance(const Vec3& a, const Vec3& b) {
  return glm::length(a - b);
}

}  // namespace

TEST_CASE("light: nothing shades itself and everything below is shaded") {
  Parameters parameters;
  parameters.casters = Casters::buds;
  Plant plant = seedling(parameters);
  plant.position.push_back(Vec3(0, -2, 0));
  plant.parent.push_back(0);
  plant.axis.push_back(0);
  plant.birth_step.push_back(1);
  plant.shed_step.push_back(kAlive);
  plant.buds.push_back({.node = 1, .axis = 0, .is_terminal = false, .direction = kUp});
  ShadowGrid shadow({.a = 0.2, .b = 2, .q_max = 4}, 1.0);
  shadow.cast(std::vector<Coord>{{0, 0, 0}, {0, -2, 0}});
  std::vector<double> light;
  sense_light(plant, parameters, shadow, 1, light);
  CHECK(light[0] == 1.0);
  CHECK(std::abs(light[1] - 0.95) < 1e-5);  // 1 - 0.2 / 4
}

TEST_CASE("light: the root node casts nothing, so its bud gets nothing back") {
  Parameters parameters;
  parameters.casters = Casters::metamers;
  const Plant plant = seedling(parameters);
  ShadowGrid shadow({}, 1.0);
  std::vector<double> light;
  sense_light(plant, parameters, shadow, 1, light);
  CHECK(light[0] == 1.0);
}

TEST_CASE("light: exposure is never negative") {
  Parameters parameters;
  const Plant plant = seedling(parameters);
  ShadowGrid shadow({}, 1.0);
  shadow.cast(std::vector<Coord>(100, Coord(0, 0, 0)));
  std::vector<double> light;
  sense_light(plant, parameters, shadow, 1, light);
  CHECK(light[0] == 0.0);
}

TEST_CASE("best direction: without shadow all voxels tie and their mean is the axis itself") {
  const ShadowGrid shadow({}, 1.0);
  for (const Vec3 axis : {Vec3(0, 1, 0), Vec3(1, 0, 0), glm::normalize(Vec3(1, 1, 1))}) {
    const LightSeeker seeker(parameters_with(2, 90, Tie::mean), shadow, 1);
    CHECK(distance(seeker.best_direction(Vec3(0.0), axis), axis) < 1e-9);
  }
}

TEST_CASE("best direction: without shadow the first of the tied voxels leans to low x") {
  const ShadowGrid shadow({}, 1.0);
  const LightSeeker seeker(parameters_with(1.8, 90, Tie::first), shadow, 1);
  const Vec3 first = seeker.best_direction(Vec3(0.0), kUp);
  CHECK(distance(first, glm::normalize(Vec3(-1, 1, 0))) < 1e-9);
}

TEST_CASE("best direction: away from a caster on one side") {
  ShadowGrid shadow({}, 1.0);
  shadow.cast(std::vector<Coord>{{2, 3, 0}});
  const LightSeeker seeker(parameters_with(2, 120, Tie::mean), shadow, 1);
  CHECK(seeker.best_direction(Vec3(0.0), kUp).x < -0.1);
}

TEST_CASE("best direction: stays within the cone, and is the axis where the cone holds no voxel") {
  ShadowGrid shadow({}, 1.0);
  shadow.cast(std::vector<Coord>{{0, 2, 0}, {1, 2, 0}, {0, 1, 1}});
  const Vec3 axis = glm::normalize(Vec3(0.3, 1, 0.2));
  const LightSeeker wide(parameters_with(3, 60, Tie::mean), shadow, 1);
  CHECK(glm::dot(wide.best_direction(Vec3(0.1, 0.2, -0.3), axis), axis) >= std::cos(radians(30)) - 1e-9);
  const LightSeeker blind(parameters_with(0.4, 90, Tie::mean), shadow, 1);
  CHECK(blind.best_direction(Vec3(0.0), axis) == axis);
  const LightSeeker narrow(parameters_with(3, 0, Tie::mean), shadow, 1);
  CHECK(narrow.best_direction(Vec3(0.0), axis) == axis);
}
