#include "pathplan/orientation.h"

#include <algorithm>

#include "tests/catch.h"

using namespace ramify;
using namespace ramify::pathplan;

namespace {

Rng numbers(std::uint64_t index = 0) {
  return Rng::stream(1, Stream::v_g, 1, index);
}

Vec3 direction_of(const Level& row, const Vec3& outwards, std::uint64_t index = 0, const Light& light = {}) {
  Rng rng = numbers(index);
  return subgraph_direction(row, light, outwards, rng);
}

Level turned_by(double degrees) {
  Level row;
  row.turn_deg = degrees;
  return row;
}

bool is_near(const Vec3& a, const Vec3& b) {
  return glm::distance(a, b) < 1e-9;
}

/// Above the horizon, degrees.
double elevation(const Vec3& direction) {
  return degrees(std::atan2(direction.y, std::hypot(direction.x, direction.z)));
}

std::vector<Vec3> directions_all_round() {
  std::vector<Vec3> directions;
  Rng rng = Rng::stream(3, Stream::bud, 0);
  for (int i = 0; i < 200; ++i) {
    const Vec3 v(rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0));
    directions.push_back(normalized_or(v, kUp, 0.05));
  }
  return directions;
}

}  // namespace

TEST_CASE("v_g: it leads on outwards, or where the row says, whatever that vector's length") {
  const Vec3 outwards = glm::normalize(Vec3(1.0, 2.0, -3.0));
  Level row;
  CHECK(direction_of(row, outwards) == outwards);
  row.v_g = Orientation::fixed;
  row.v_g_direction = {0.0, -3.0, 4.0};
  CHECK(is_near(direction_of(row, outwards), {0.0, -0.6, 0.8}));
}

TEST_CASE("v_g: a random one is uniform over the sphere and has nothing to do with outwards") {
  Level row;
  row.v_g = Orientation::random;
  CHECK(direction_of(row, kUp, 5) == direction_of(row, Vec3(1.0, 0.0, 0.0), 5));
  constexpr int kCount = 40'000;
  int octants[8] = {};
  int caps[3] = {};  // each of a tenth of the sphere, about x, y and z
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const Vec3 v = direction_of(row, kUp, i);
    REQUIRE(std::abs(glm::length(v) - 1.0) < 1e-12);
    ++octants[(v.x < 0 ? 1 : 0) + (v.y < 0 ? 2 : 0) + (v.z < 0 ? 4 : 0)];
    for (int axis = 0; axis < 3; ++axis) caps[axis] += v[axis] > 0.8 ? 1 : 0;
  }
  // Four standard deviations.
  for (const int octant : octants) CHECK(std::abs(octant - kCount / 8) < 4 * 66);
  for (const int cap : caps) CHECK(std::abs(cap - kCount / 10) < 4 * 60);
}

TEST_CASE("v_g: it is turned up, or down, by the angle given and keeps its azimuth") {
  const Vec3 east(1.0, 0.0, 0.0);
  CHECK(is_near(direction_of(turned_by(30.0), east), {std::cos(radians(30.0)), 0.5, 0.0}));
  CHECK(is_near(direction_of(turned_by(-60.0), east), {0.5, -std::sin(radians(60.0)), 0.0}));
  for (const Vec3& outwards : directions_all_round()) {
    for (const double turn : {-180.0, -75.0, -20.0, 0.0, 1.0, 45.0, 100.0}) {
      const Vec3 v = direction_of(turned_by(turn), outwards);
      CHECK(std::abs(glm::length(v) - 1.0) < 1e-12);
      // Never past the vertical.
      const double expected = std::clamp(elevation(outwards) + turn, -90.0, 90.0);
      CHECK(std::abs(elevation(v) - expected) < 1e-6);
      if (std::abs(expected) == 90.0) continue;
      CHECK(v.x * outwards.x + v.z * outwards.z > 0.0);
      CHECK(std::abs(v.x * outwards.z - v.z * outwards.x) < 1e-9);
    }
  }
}

TEST_CASE("v_g: from the vertical it turns to a drawn azimuth, all of them alike") {
  for (const double side : {1.0, -1.0}) {
    const Vec3 outwards = side * kUp;
    const Level away = turned_by(-40.0 * side);
    int quarters[4] = {};
    for (std::uint64_t i = 0; i < 4000; ++i) {
      const Vec3 v = direction_of(away, outwards, i);
      REQUIRE(std::abs(elevation(v) - 50.0 * side) < 1e-6);
      REQUIRE(v == direction_of(away, outwards, i));
      ++quarters[(v.x < 0 ? 1 : 0) + (v.z < 0 ? 2 : 0)];
    }
    for (const int quarter : quarters) CHECK(std::abs(quarter - 1000) < 4 * 28);
    CHECK(is_near(direction_of(turned_by(40.0 * side), outwards), outwards));  // on past it: it stays
  }
}

TEST_CASE("v_g: numbers are drawn only where they are needed") {
  Rng used = numbers();
  subgraph_direction(turned_by(20.0), {}, glm::normalize(Vec3(1.0, 1.0, 1.0)), used);
  subgraph_direction(turned_by(0.0), {}, kUp, used);
  CHECK(used.next() == numbers().next());
}

TEST_CASE("v_g: light pulls it by its weight, after it was turned") {
  const Vec3 east(1.0, 0.0, 0.0);
  const Light up{.direction = {0.0, 7.0, 0.0}, .pull = 1.0};
  CHECK(is_near(direction_of({}, east, 0, up), glm::normalize(Vec3(1.0, 1.0, 0.0))));
  CHECK(is_near(direction_of({}, east, 0, {.direction = {0.0, 7.0, 0.0}, .pull = 3.0}),
                glm::normalize(Vec3(1.0, 3.0, 0.0))));
  CHECK(is_near(direction_of(turned_by(-90.0), east, 0, {.direction = {0.5, 0.0, 0.0}, .pull = 1.0}),
                glm::normalize(Vec3(1.0, -1.0, 0.0))));
  CHECK(direction_of({}, -kUp, 0, up) == -kUp);  // a tie of opposites

  for (const Vec3& outwards : directions_all_round()) {
    double before = glm::dot(outwards, kUp);
    for (const double pull : {0.1, 0.5, 2.0, 100.0}) {
      const Vec3 v = direction_of({}, outwards, 0, {.direction = kUp, .pull = pull});
      CHECK(std::abs(glm::length(v) - 1.0) < 1e-12);
      CHECK(glm::dot(v, kUp) >= before - 1e-12);
      before = glm::dot(v, kUp);
    }
    CHECK(before > 0.99);
  }
}
