#include "common/base/geometry.h"

#include "common/base/rng.h"
#include "common/config/schedule.h"
#include "tests/catch.h"

using namespace ramify;

namespace {

double distance(const Vec3& a, const Vec3& b) {
  return glm::length(a - b);
}

Vec3 random_direction(Rng& random) {
  return glm::normalize(Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
}

}  // namespace

TEST_CASE("geometry: a quarter turn about Y takes Z to X") {
  CHECK(distance(rotated(Vec3(0, 0, 1), kUp, radians(90)), Vec3(1, 0, 0)) < 1e-12);
  CHECK(distance(rotated(Vec3(1, 2, 3), kUp, radians(360)), Vec3(1, 2, 3)) < 1e-12);
}

TEST_CASE("geometry: a transported normal stays a unit normal and turns no more than the tangent") {
  Rng random = Rng::stream(1, Stream::bud, 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 from = random_direction(random);
    const Vec3 to = random_direction(random);
    const Vec3 normal = perpendicular_at(from, random.uniform(0, 6));
    const Vec3 carried = transported(normal, from, to);
    CHECK(std::abs(glm::length(carried) - 1.0) < 1e-12);
    CHECK(std::abs(glm::dot(carried, to)) < 1e-12);
    CHECK(glm::dot(carried, normal) >= glm::dot(from, to) - 1e-9);
  }
}

TEST_CASE("geometry: a normal survives a tangent that turns right round") {
  const Vec3 carried = transported(Vec3(1, 0, 0), kUp, -kUp);
  CHECK(std::abs(glm::length(carried) - 1.0) < 1e-12);
  CHECK(std::abs(carried.y) < 1e-12);
}

TEST_CASE("geometry: normalized_or falls back where there is no direction") {
  CHECK(normalized_or(Vec3(0.0), kUp) == kUp);
  CHECK(distance(normalized_or(Vec3(0, 0, 5), kUp), Vec3(0, 0, 1)) < 1e-15);
}

TEST_CASE("schedule: constant outside its points and linear between them") {
  const Schedule schedule(std::vector<std::pair<double, double>>{{2, 10}, {4, 20}, {8, 0}});
  CHECK(schedule.at(0) == 10);
  CHECK(schedule.at(2) == 10);
  CHECK(schedule.at(3) == 15);
  CHECK(schedule.at(4) == 20);
  CHECK(schedule.at(7) == 5);
  CHECK(schedule.at(100) == 0);
  CHECK(Schedule(3.5).at(77) == 3.5);
}
