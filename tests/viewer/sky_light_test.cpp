#include "viewer/sky_light.h"

#include <algorithm>

#include "tests/catch.h"
#include "tests/viewer/poles.h"

using namespace ramify;
using namespace ramify::test;

TEST_CASE("sky light: an empty mesh has none to weaken") {
  CHECK(sky_light(Mesh(), 0.0).visibility.empty());
}

TEST_CASE("sky light: the whole sky is seen from the top, less of it from under a roof") {
  // A roof of 4 m x 4 m, 2 m above the ground, in triangles of about 10 cm.
  Mesh roof;
  constexpr int kSide = 40;
  for (int z = 0; z <= kSide; ++z) {
    for (int x = 0; x <= kSide; ++x) roof.positions.emplace_back(Vec3(0.1 * x - 2.0, 2.0, 0.1 * z - 2.0));
  }
  for (std::uint32_t z = 0; z < kSide; ++z) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t corner = z * (kSide + 1) + x;
      roof.triangles.push_back({corner, corner + 1, corner + kSide + 1});
      roof.triangles.push_back({corner + 1, corner + kSide + 2, corner + kSide + 1});
    }
  }
  const SkyLight sky = sky_light(roof, 0.0);
  const Coord middle = sky.size / 2;
  const int under = sky.visibility[sky.index(middle.x, 0, middle.z)];
  const int beside = sky.visibility[sky.index(0, 0, 0)];
  CHECK(sky.visibility[sky.index(middle.x, sky.size.y - 1, middle.z)] == 255);
  CHECK(under < 235);
  CHECK(under < beside);
}

TEST_CASE("sky light: nothing casts more than it can") {
  const SkyLight sky = sky_light(tube_mesh(pole_of(4, 8.0, 0.5)), 0.0);
  REQUIRE(sky.visibility.size() == static_cast<std::size_t>(sky.size.x) * sky.size.y * sky.size.z);
  CHECK(std::max({sky.size.x, sky.size.y, sky.size.z}) <= 49);
  CHECK(*std::max_element(sky.visibility.begin(), sky.visibility.end()) == 255);
}
