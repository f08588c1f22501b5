#include "growth/marker_grid.h"

#include <algorithm>
#include <array>
#include <set>

#include "common/base/parallel.h"
#include "common/base/rng.h"
#include "common/volume/solid.h"
#include "common/volume/volume.h"
#include "growth/marker_cone.h"
#include "growth/markers.h"
#include "tests/catch.h"

using namespace ramify;
using namespace ramify::growth;

namespace {

/// Unlike along each axis.
const Box kBox{Vec3(-3.0, 10.0, 2.0), Vec3(1.0, 12.5, 8.0)};

Vec3 random_place(Rng& random, double beyond) {
  const double x = random.uniform(-beyond, 1.0 + beyond);
  const double y = random.uniform(-beyond, 1.0 + beyond);
  const double z = random.uniform(-beyond, 1.0 + beyond);
  return kBox.size() * Vec3(x, y, z);
}

Vec3 random_direction(Rng& random) {
  return glm::normalize(random_place(random, 0.0) / kBox.size() - 0.5 + Vec3(1e-9));
}

MarkerGrid random_grid(std::size_t count, double reach, std::uint64_t seed) {
  const auto draw = [&](std::size_t first, std::span<Vec3f> offsets) {
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      Rng random = Rng::stream(seed, Stream::marker, first + i);
      offsets[i] = Vec3f(random_place(random, 0.0));
    }
  };
  return MarkerGrid(kBox, reach, count, draw);
}

/// Of all places in the groups.
std::set<std::size_t> places_in(std::span<const std::uint32_t> groups) {
  std::set<std::size_t> places;
  for (const std::uint32_t group : groups) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) places.insert(group + lane);
  }
  return places;
}

/// How many markers within the cone are in none of the groups.
std::size_t missed(const MarkerGrid& grid, const Cone& cone, std::span<const std::uint32_t> groups) {
  const std::set<std::size_t> found = places_in(groups);
  std::size_t count = 0;
  for (std::size_t place = 0; place < grid.place_count(); ++place) {
    const Vec3 to_marker = grid.offset(place) - cone.apex;
    count += cone.contains(to_marker, glm::dot(to_marker, to_marker)) && !found.contains(place);
  }
  return count;
}

}  // namespace

TEST_CASE("marker grid: no marker in a cone is missed, however many around were taken") {
  struct Family {
    std::size_t count;
    double reach;
  };
  for (const Family& family :
       {Family{20000, 0.5}, Family{20000, 0.1}, Family{300, 0.4}, Family{40000, 2.5}}) {
    MarkerGrid grid = random_grid(family.count, family.reach, 3);
    MarkerGrid::Search search;
    Rng random = Rng::stream(7, Stream::bud, 0);
    for (int round = 0; round < 4; ++round) {
      for (const double theta_deg : {0.0, 30.0, 90.0, 140.0, 180.0, 250.0, 360.0}) {
        INFO(family.count << " markers, reach " << family.reach << ", round " << round << ", theta "
                          << theta_deg);
        const ConeShape shape(family.reach * random.uniform(0.5, 1.0), std::cos(radians(theta_deg / 2.0)));
        std::size_t count = 0;
        for (int i = 0; i < 30; ++i) {
          Vec3 direction = random_direction(random);
          if (i < 6) {
            // Along the axes boxes and roots are at their ends.
            direction = Vec3(0.0);
            direction[i / 2] = i % 2 == 0 ? 1.0 : -1.0;
          }
          const Cone cone{shape, random_place(random, 0.2), direction};
          count += missed(grid, cone, grid.find(cone.lens(), search));
        }
        CHECK(count == 0);
      }
      for (int i = 0; i < 40; ++i) grid.take_within(random_place(random, 0.0), 0.3, search);
    }
    CHECK(grid.count() < family.count);
  }
}

TEST_CASE("marker grid: a search passes over most of the markers that are elsewhere or taken") {
  MarkerGrid grid = random_grid(60000, 0.5, 1);
  MarkerGrid::Search search;
  const ConeShape shape(0.5, std::cos(radians(45.0)));
  const Cone cone{shape, 0.5 * kBox.size(), glm::normalize(Vec3(1.0, 2.0, -1.0))};
  // 60 m^3: a cone of 0.077 m^3 holds 77 markers.
  const std::size_t before = places_in(grid.find(cone.lens(), search)).size();
  CHECK(before >= 77);
  CHECK(before < 600);
  // Every marker is taken but those in a thin layer in the middle.
  Rng random = Rng::stream(2, Stream::bud, 0);
  for (int i = 0; i < 40000; ++i) {
    Vec3 place = random_place(random, 0.05);
    if (std::abs(place.y - cone.apex.y) < 0.25) continue;
    grid.take_within(place, 0.2, search);
  }
  CHECK(missed(grid, cone, grid.find(cone.lens(), search)) == 0);
  CHECK(places_in(grid.find(cone.lens(), search)).size() < before / 2);
}

TEST_CASE("marker grid: what is taken is within the radius, counted, and gone for good") {
  for (const double radius : {0.0, 0.05, 0.4, 3.0}) {
    MarkerGrid grid = random_grid(5000, 0.3, 4);
    MarkerGrid::Search search;
    Rng random = Rng::stream(5, Stream::bud, 0);
    for (int i = 0; i < 20; ++i) {
      const Vec3 place = random_place(random, 0.3);
      std::vector<Vec3> expected = grid.points();
      std::erase_if(expected, [&](const Vec3& point) {
        return glm::distance(Vec3(Vec3f(point - kBox.low)), place) <= radius;
      });
      grid.take_within(place, radius, search);
      CHECK(grid.points() == expected);
      CHECK(grid.count() == expected.size());
    }
  }
}

TEST_CASE("marker grid: places do not depend on the number of threads") {
  std::vector<std::vector<Vec3>> points;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    points.push_back(random_grid(100000, 0.2, 9).points());
    CHECK(points.back() == points.front());
  }
  CHECK(points.front().size() == 100000);
}

TEST_CASE("marker grid: claims stay right while a wave of nodes takes what is near") {
  const ConeShape shape(0.5, std::cos(radians(50.0)));
  const Solid solid({.shape = Shape::box, .center = Vec3(0.0), .size = Vec3(2.0)});
  Markers markers(solid, 8.0, 1000.0, 1, shape.radius);
  Rng random = Rng::stream(6, Stream::bud, 0);
  for (double front = -1.0; front < 1.0; front += 0.2) {
    std::vector<Seeker> seekers;
    std::vector<Vec3> nodes;
    for (int i = 0; i < 150; ++i) {
      const Vec3 node(random.uniform(-1.0, 1.0), front, random.uniform(-1.0, 1.0));
      nodes.push_back(node);
      // Two buds a node, as at a tip: equally far from all.
      for (int bud = 0; bud < 2; ++bud) {
        seekers.push_back(
            {node, glm::normalize(random_direction(random) + kUp), shape.radius, shape.min_cosine});
      }
    }
    markers.occupy(nodes, 0.2);

    std::vector<std::uint32_t> expected(seekers.size());
    for (const Vec3& marker : markers.layer().points) {
      std::size_t owner = seekers.size();
      float nearest = std::numeric_limits<float>::infinity();
      for (std::size_t i = 0; i < seekers.size(); ++i) {
        const Vec3 to_marker = marker - seekers[i].position;
        const double square = glm::dot(to_marker, to_marker);
        const Cone cone{shape, seekers[i].position, seekers[i].direction};
        if (!cone.contains(to_marker, square) || static_cast<float>(square) >= nearest) continue;
        nearest = static_cast<float>(square);
        owner = i;
      }
      if (owner < seekers.size()) ++expected[owner];
    }
    std::vector<Claim> claims;
    markers.claim(seekers, claims);
    std::vector<std::uint32_t> got;
    for (const Claim& claim : claims) got.push_back(claim.markers);
    CHECK(got == expected);
  }
  CHECK(markers.count() < 5000);
}
