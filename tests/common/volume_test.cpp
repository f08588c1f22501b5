#include "common/volume/volume.h"

#include <numbers>
#include <string>
#include <vector>

#include "common/base/errors.h"
#include "tests/catch.h"
#include "tests/common/solids.h"

using namespace ramify;
using ramify::test::is_near;
using ramify::test::known_volumes;
using ramify::test::KnownVolume;
using ramify::test::points_around;
using ramify::test::problem_of;
using ramify::test::tilts;

namespace {

constexpr double kPi = std::numbers::pi;

Volume two_balls(double apart) {
  return {.shape = Shape::union_of,
          .parts = {{.shape = Shape::sphere, .radius = 1},
                    {.shape = Shape::sphere, .center = {apart, 0, 0}, .radius = 1}}};
}

}  // namespace

TEST_CASE("volume: the counted size is the one in the textbook, tilted or not") {
  for (const KnownVolume& known : known_volumes()) {
    INFO(known.name);
    CHECK(is_near(volume_of(known.volume), known.cubic_metres, 0.003 * known.cubic_metres));
  }
  const Volume ball{.shape = Shape::sphere, .radius = 1};
  CHECK(is_near(volume_of(ball, 3'000'000), 4.0 / 3 * kPi, 0.001));
  CHECK(volume_of(ball) == volume_of(ball));
}

TEST_CASE("volume: what two parts share counts once") {
  const double one = 4.0 / 3 * kPi;
  const double lens = kPi * (4 + 1) * 1.0 / 12;  // of unit balls at distance 1
  CHECK(is_near(volume_of(two_balls(1)), 2 * one - lens, 0.03));
  CHECK(is_near(volume_of(two_balls(5)), 2 * one, 0.05));
  CHECK(is_near(volume_of(two_balls(0)), one, 0.02));
  const Volume ball{.shape = Shape::sphere, .radius = 1};
  const Volume other{.shape = Shape::sphere, .center = {1, 0, 0}, .radius = 1};
  const Volume far{.shape = Shape::sphere, .center = {9, 0, 0}, .radius = 1};
  CHECK(is_near(shared_volume_of(ball, other), lens, 0.01));
  CHECK(shared_volume_of(ball, far) == 0.0);
}

TEST_CASE("volume: unions may be nested and a union without parts holds nothing") {
  const Volume nested{.shape = Shape::union_of, .parts = {two_balls(1), two_balls(4)}};
  CHECK(contains(nested, {4.9, 0, 0}));
  CHECK_FALSE(contains(nested, {2.5, 0, 0}));
  const Volume none{.shape = Shape::union_of};
  CHECK_FALSE(contains(none, {0, 0, 0}));
  CHECK(bounds(none).is_empty());
  CHECK(volume_of(none) == 0.0);
}

TEST_CASE("volume: a point on the surface is inside, whatever the direction") {
  for (const Vec3& direction : tilts()) {
    const Vec3 axis = glm::normalize(direction);
    const Vec3 side = any_perpendicular(axis);
    for (const Shape shape : {Shape::cylinder, Shape::cone, Shape::hemisphere, Shape::sphere_portion}) {
      const Volume volume{.shape = shape,
                          .center = {1, 2, 3},
                          .radius = 0.7,
                          .height = 2,
                          .angle_deg = 30,
                          .direction = direction};
      CHECK(contains(volume, volume.center));
      if (shape == Shape::sphere_portion) continue;
      CHECK(contains(volume, volume.center + 0.7 * side));
      CHECK_FALSE(contains(volume, volume.center + 0.701 * side));
      CHECK_FALSE(contains(volume, volume.center - 0.001 * axis));
    }
  }
}

TEST_CASE("volume: the box holds all of the volume and is tight around it, tilted or not") {
  for (const KnownVolume& known : known_volumes()) {
    INFO(known.name);
    const Box box = bounds(known.volume);
    Box met;
    for (const Vec3& point : points_around(known.volume, 20'000)) {
      if (contains(known.volume, point)) met.include(point);
    }
    for (int i = 0; i < 3; ++i) {
      CHECK(met.low[i] >= box.low[i] - 1e-9);
      CHECK(met.high[i] <= box.high[i] + 1e-9);
      // Nobody works out what a cut leaves of the box.
      if (known.volume.shape == Shape::difference) continue;
      // Random points hardly ever meet the very tip of a cone or spindle.
      CHECK(met.low[i] <= box.low[i] + 0.15 * box.size()[i]);
      CHECK(met.high[i] >= box.high[i] - 0.15 * box.size()[i]);
    }
  }
  const Volume leaning{.shape = Shape::cylinder, .radius = 1, .height = 2, .direction = {1, 1, 0}};
  CHECK(is_near(bounds(leaning).low.x, -std::sqrt(0.5), 1e-12));
  CHECK(is_near(bounds(leaning).high.x, 1.5 * std::sqrt(2.0), 1e-12));
  CHECK(is_near(bounds(leaning).high.z, 1.0, 1e-12));
}

TEST_CASE("volume: what is said to be farther away is") {
  for (const KnownVolume& known : known_volumes()) {
    const Solid solid(known.volume);
    const std::vector<Vec3> points = points_around(known.volume, 300);
    for (const Vec3& from : points) {
      for (const Vec3& to : points) {
        if (!solid.contains(to)) continue;
        REQUIRE_FALSE(solid.is_farther(from, glm::distance(from, to) + 1e-9));
      }
    }
  }
  const Solid ball({.shape = Shape::sphere, .radius = 1});
  CHECK(ball.is_farther({5, 0, 0}, 3.9));
}

TEST_CASE("volume: a segment between two points of one convex part lies inside") {
  std::vector<KnownVolume> family = known_volumes();
  family.push_back({"two balls", two_balls(1.5), 0});
  for (const KnownVolume& known : family) {
    const Solid solid(known.volume);
    const std::vector<Vec3> points = points_around(known.volume, 120);
    for (const Vec3& a : points) {
      for (const Vec3& b : points) {
        if (!solid.convex_part(a) || solid.convex_part(a) != solid.convex_part(b)) continue;
        for (int i = 0; i <= 8; ++i) REQUIRE(solid.contains(a + i / 8.0 * (b - a)));
      }
    }
  }
}

TEST_CASE("volume: depth is the distance to the round faces, not to the flat ones") {
  const Volume ball{.shape = Shape::sphere, .center = {1, 0, 0}, .radius = 2};
  CHECK(is_near(outer_depth(ball, {1, 0, 0}), 2.0, 1e-12));
  CHECK(is_near(outer_depth(ball, {1, 1.5, 0}), 0.5, 1e-12));
  CHECK(outer_depth(ball, {4, 0, 0}) == 0.0);

  const Volume dome{.shape = Shape::hemisphere, .radius = 3};
  CHECK(is_near(outer_depth(dome, {1, 0.01, 0}), 3 - std::hypot(1, 0.01), 1e-12));

  const Volume portion{.shape = Shape::sphere_portion, .radius = 3, .angle_deg = 20, .direction = {1, 0, 0}};
  CHECK(is_near(outer_depth(portion, {0, 0, 0}), 3.0, 1e-12));
  CHECK(is_near(outer_depth(portion, {2, 0.5, 0}), 3 - std::hypot(2, 0.5), 1e-12));

  const Volume log{.shape = Shape::cylinder, .radius = 1, .height = 4, .direction = {0, 0, 1}};
  CHECK(is_near(outer_depth(log, {0.2, 0, 2}), 0.8, 1e-12));
  CHECK(is_near(outer_depth(log, {0.2, 0, 3.9}), 0.1, 1e-12));  // the far end
  CHECK(is_near(outer_depth(log, {0.2, 0, 0.1}), 0.8, 1e-12));  // not the base

  const Volume cone{.shape = Shape::cone, .radius = 1, .height = 1};
  CHECK(is_near(outer_depth(cone, {0, 0, 0}), std::sqrt(0.5), 1e-12));
  CHECK(is_near(outer_depth(cone, {0.5, 0, 0}), 0.5 * std::sqrt(0.5), 1e-12));
}

TEST_CASE("volume: an ellipsoid's depth is the distance to the nearest of many points of its surface") {
  const Volume egg{.shape = Shape::ellipsoid, .radii = {1, 2, 3}};
  CHECK(is_near(outer_depth(egg, {0, 0, 0}), 1.0, 1e-9));
  CHECK(is_near(outer_depth(egg, {0, 0, 2.9}), 0.1, 1e-9));
  CHECK(is_near(outer_depth(egg, {0, 1.9, 0}), 0.1, 1e-9));
  const Volume flat{.shape = Shape::ellipsoid, .radii = {2, 1, 2}};
  CHECK(is_near(outer_depth(flat, {0, 0, 0}), 1.0, 1e-9));

  for (const Vec3& point : {Vec3(0.5, 1, 1), Vec3(-0.2, 0.3, 2.5), Vec3(0.9, -0.1, 0), Vec3(0, 1.2, -1)}) {
    double nearest = 10;
    for (int i = 0; i <= 1000; ++i) {
      for (int j = 0; j <= 1000; ++j) {
        const double polar = kPi * i / 1000;
        const double azimuth = 2 * kPi * j / 1000;
        const Vec3 surface(std::sin(polar) * std::cos(azimuth), 2 * std::sin(polar) * std::sin(azimuth),
                           3 * std::cos(polar));
        nearest = std::min(nearest, glm::distance(point, surface));
      }
    }
    CHECK(is_near(outer_depth(egg, point), nearest, 1e-3));
  }
}

TEST_CASE("volume: faces inside a union do not count for its depth") {
  // The trunk's far end is inside the crown or flush with its flat side; its mantle below is free.
  for (const double top : {3.0, 3.5}) {
    const Volume mushroom{.shape = Shape::union_of,
                          .parts = {{.shape = Shape::cylinder, .radius = 0.5, .height = top},
                                    {.shape = Shape::hemisphere, .center = {0, 3, 0}, .radius = 2}}};
    CHECK(is_near(outer_depth(mushroom, {0.1, 2.99, 0}), 0.4, 1e-9));
    CHECK(is_near(outer_depth(mushroom, {0.1, 3.01, 0}), 2 - std::hypot(0.1, 0.01), 1e-9));
    CHECK(is_near(outer_depth(mushroom, {0, 4.9, 0}), 0.1, 1e-9));
  }
  // Between two balls the nearest face is the circle where they meet.
  const double circle = std::sqrt(1 - 0.25);
  CHECK(is_near(outer_depth(two_balls(1), {0.5, 0, 0}), circle, 0.1));
  CHECK(outer_depth(two_balls(1), {0.5, 0, 0}) >= circle);
  CHECK(is_near(outer_depth(two_balls(1), {-0.9, 0, 0}), 0.1, 1e-9));
  CHECK(is_near(outer_depth(two_balls(0), {0.3, 0, 0}), 0.7, 1e-9));
}

TEST_CASE("volume: what cannot be is named with its key") {
  CHECK(problem_of("levels.1.volume", {.shape = Shape::union_of}) ==
        "levels.1.volume: a union without parts (at least one part)");
  CHECK(problem_of("levels.1.volume", {.shape = Shape::cone, .direction = {0, 0, 0}}) ==
        "levels.1.volume.direction: its length is 0 (any other length; only where it points counts)");
  CHECK(problem_of("levels.1.volume", {.shape = Shape::union_of,
                                       .parts = {{.shape = Shape::sphere},
                                                 {.shape = Shape::cylinder, .direction = {0, 0, 0}}}}) ==
        "levels.1.volume.parts.2.direction: its length is 0 (any other length; only where it points counts)");
  CHECK(problem_of("levels.1.volume",
                   {.shape = Shape::sphere_portion, .radius = 1, .angle_deg = 0.001, .direction = {1, 1, 1}})
            .find("nothing inside") != std::string::npos);
  CHECK(problem_of("levels.1.volume", {.shape = Shape::sphere, .direction = {0, 0, 0}}).empty());
  CHECK(problem_of("levels.1.volume", two_balls(1)).empty());
}
