#include "growth/environment_light.h"

#include "common/base/rng.h"
#include "tests/catch.h"
#include "tests/growth/plants.h"

using namespace ramify;
using namespace ramify::growth;
using namespace ramify::test;

namespace {

TreeParameters parameters_with(double r, double theta_deg, Tie tie) {
  TreeParameters parameters;
  parameters.r = r;
  parameters.theta_deg = theta_deg;
  parameters.tie = tie;
  return parameters;
}

MappedVector<double> sensed(const Plant& plant, const Parameters& parameters, const ShadowGrid& shadow,
                            int step = 1) {
  MappedVector<double> light;
  sense_light(plant, parameters, parameters, LightField(shadow, parameters.shadow, 1), step, light);
  return light;
}

double distance(const Vec3& a, const Vec3& b) {
  return glm::length(a - b);
}

}  // namespace

TEST_CASE("light: nothing shades itself and everything below is shaded") {
  Parameters parameters;
  parameters.casters = Casters::buds;
  ShadowGrid shadow({.a = 0.2, .b = 2, .q_max = 4}, 1.0);
  Plant plant = test::seedling(shadow.site_of({0, 0, 0}));
  add_node(plant, 0, 0, {0, -2, 0});
  add_bud(plant, {.node = 1, .site = shadow.site_of({0, -2, 0})});
  shadow.cast(std::vector<Coord>{{0, 0, 0}, {0, -2, 0}});
  const MappedVector<double> light = sensed(plant, parameters, shadow);
  CHECK(light[0] == 1.0);
  CHECK(std::abs(light[1] - 0.95) < 1e-5);  // 1 - 0.2 / 4
}

TEST_CASE("light: the root node casts nothing, so its bud gets nothing back") {
  ShadowGrid shadow({}, 1.0);
  CHECK(sensed(test::seedling(shadow.site_of({0, 0, 0})), {}, shadow)[0] == 1.0);
}

TEST_CASE("light: exposure is never negative") {
  ShadowGrid shadow({}, 1.0);
  Plant plant = test::seedling(shadow.site_of({0, 0, 0}));
  shadow.cast(std::vector<Coord>(100, Coord(0, 0, 0)));
  CHECK(sensed(plant, {}, shadow)[0] == 0.0);
}

TEST_CASE("light: a metamer whose leaves fell casts nothing, so its buds get nothing back") {
  Parameters parameters;
  parameters.leaf_lifespan = 3;
  ShadowGrid shadow({}, 1.0);
  Plant plant = test::seedling(shadow.site_of({0, 0, 0}));
  add_node(plant, 0, 0);  // born in step 1
  plant.buds = {{.node = 1, .site = shadow.site_of({0, 0, 0})}};
  shadow.cast(std::vector<Coord>{{0, 0, 0}});
  CHECK(sensed(plant, parameters, shadow, 4)[0] == 1.0);
  CHECK(std::abs(sensed(plant, parameters, shadow, 5)[0] - 0.8) < 1e-5);
}

TEST_CASE("light: a multiplicative field leaves an uneven sky, and its factors under a caster") {
  Parameters parameters;
  parameters.shadow = ShadowModel::multiplicative;
  ShadowGrid shadow({.model = ShadowModel::multiplicative}, 1.0);
  const LightField field(shadow, parameters.shadow, 7);
  double lowest = 1.0, highest = 0.0, before = field.light({0, -1, 0}), side = field.light({1, -1, 0});
  for (int x = 0; x < 500; ++x) {
    const double sky = field.light(Vec3(x, 0, 0));
    lowest = std::min(lowest, sky);
    highest = std::max(highest, sky);
  }
  CHECK(lowest > 0.9499);
  CHECK(lowest < 0.951);
  CHECK(highest < 1.0001);
  CHECK(highest > 0.999);

  const double own = field.light({0, 0, 0});
  shadow.cast(std::vector<Coord>{{0, 0, 0}});
  CHECK(field.light({0, 0, 0}) == own);  // there is no level 0
  CHECK(std::abs(field.light({0, -1, 0}) / before - (1 - 0.441 / 6.31)) < 1e-4);
  CHECK(std::abs(field.light({1, -1, 0}) / side - (1 - 0.441 * std::pow(6.31, -std::sqrt(2.0)))) < 1e-4);
  const double middle = field.light({0.5, -1, 0});
  CHECK(std::abs(middle - 0.5 * (field.light({0, -1, 0}) + field.light({1, -1, 0}))) < 1e-12);
}

TEST_CASE("light: the slope points from shadow to light and is 0 where nothing changes") {
  ShadowGrid shadow({}, 1.0);
  const LightField field(shadow, ShadowModel::additive, 1);
  CHECK(field.slope({0, 0, 0}, 1.0) == Vec3(0.0));
  shadow.cast(std::vector<Coord>{{2, 0, 0}});
  CHECK(std::abs(field.slope({1, 0, 0}, 1.0).x + 0.1) < 1e-5);  // 0.2 over 2 voxels
  CHECK(std::abs(field.slope({2, -0.5, 0}, 0.5).y + 0.1) < 1e-5);

  TreeParameters tree;
  tree.optimal_from = OptimalFrom::gradient;
  tree.gradient_max = 0.03;
  const LightSeeker seeker(tree, field, 1);
  CHECK(std::abs(glm::length(seeker.best_direction({1, 0, 0}, kUp)) - 0.03) < 1e-9);
  CHECK(seeker.best_direction({1, 0, 0}, kUp).x < -0.02);
}

TEST_CASE("best direction: without shadow all voxels tie and their mean is the axis itself") {
  const ShadowGrid shadow({}, 1.0);
  const LightField field(shadow, ShadowModel::additive, 1);
  for (const Vec3 axis : {Vec3(0, 1, 0), Vec3(1, 0, 0), glm::normalize(Vec3(1, 1, 1))}) {
    const LightSeeker seeker(parameters_with(2, 90, Tie::mean), field, 1);
    CHECK(distance(seeker.best_direction(Vec3(0.0), axis), axis) < 1e-9);
  }
}

TEST_CASE("best direction: without shadow the first of the tied voxels leans to low x") {
  const ShadowGrid shadow({}, 1.0);
  const LightField field(shadow, ShadowModel::additive, 1);
  const LightSeeker seeker(parameters_with(1.8, 90, Tie::first), field, 1);
  const Vec3 first = seeker.best_direction(Vec3(0.0), kUp);
  CHECK(distance(first, glm::normalize(Vec3(-1, 1, 0))) < 1e-9);
}

TEST_CASE("best direction: away from a caster on one side") {
  ShadowGrid shadow({}, 1.0);
  const LightField field(shadow, ShadowModel::additive, 1);
  shadow.cast(std::vector<Coord>{{2, 3, 0}});
  const LightSeeker seeker(parameters_with(2, 120, Tie::mean), field, 1);
  CHECK(seeker.best_direction(Vec3(0.0), kUp).x < -0.1);
}

TEST_CASE("best direction: stays within the cone, and is the axis where the cone holds no voxel") {
  ShadowGrid shadow({}, 1.0);
  const LightField field(shadow, ShadowModel::additive, 1);
  shadow.cast(std::vector<Coord>{{0, 2, 0}, {1, 2, 0}, {0, 1, 1}});
  const Vec3 axis = glm::normalize(Vec3(0.3, 1, 0.2));
  const LightSeeker wide(parameters_with(3, 60, Tie::mean), field, 1);
  CHECK(glm::dot(wide.best_direction(Vec3(0.1, 0.2, -0.3), axis), axis) >= std::cos(radians(30)) - 1e-9);
  const LightSeeker blind(parameters_with(0.4, 90, Tie::mean), field, 1);
  CHECK(blind.best_direction(Vec3(0.0), axis) == axis);
  const LightSeeker narrow(parameters_with(3, 0, Tie::mean), field, 1);
  CHECK(narrow.best_direction(Vec3(0.0), axis) == axis);
}

TEST_CASE("best direction: the cone's voxels are those that brute force finds") {
  ShadowGrid shadow({}, 1.0);
  Rng random = Rng::stream(5, Stream::dart, 0);
  const auto number = [&] { return random.uniform(-1.0, 1.0); };
  std::vector<Coord> casters;
  for (int i = 0; i < 60; ++i) casters.emplace_back(Vec3(number(), number(), number()) * 6.0);
  shadow.cast(casters);
  const LightField field(shadow, ShadowModel::additive, 1);
  for (const double theta : {0.0, 40.0, 90.0, 180.0, 250.0, 360.0}) {
    for (const double r : {0.5, 1.8, 3.3}) {
      const LightSeeker seeker(parameters_with(r, theta, Tie::mean), field, 1);
      for (int trial = 0; trial < 20; ++trial) {
        const Vec3 apex = Vec3(number(), number(), number()) * 3.0;
        const Vec3 axis = glm::normalize(Vec3(number(), number(), number()));
        Shadow least = std::numeric_limits<Shadow>::max();
        Vec3 sum(0.0);
        for (int i = 0; i < 12 * 12 * 12; ++i) {
          const Coord voxel = shadow.voxel_of(apex) + Coord(i % 12 - 6, i / 12 % 12 - 6, i / 144 - 6);
          const Vec3 towards = Vec3(voxel) - apex;
          const double length = glm::length(towards);
          const double cosine = std::cos(radians(theta / 2));
          if (voxel == shadow.voxel_of(apex) || length > r ||
              glm::dot(towards, axis) < cosine * length - 1e-9) {
            continue;
          }
          if (shadow.at(voxel) > least) continue;
          if (shadow.at(voxel) < least) sum = Vec3(0.0);
          least = shadow.at(voxel);
          sum += towards / length;
        }
        CHECK(distance(seeker.best_direction(apex, axis), normalized_or(sum, axis)) < 1e-9);
      }
    }
  }
}
