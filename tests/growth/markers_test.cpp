#include "growth/markers.h"

#include <algorithm>
#include <array>
#include <set>

#include "common/base/errors.h"
#include "common/base/parallel.h"
#include "common/base/rng.h"
#include "common/volume/volume.h"
#include "tests/catch.h"

using namespace ramify;
using namespace ramify::growth;

namespace {

constexpr double kPi = std::numbers::pi;

Solid ball(double radius, const Vec3& center = Vec3(0.0)) {
  return Solid({.shape = Shape::sphere, .center = center, .radius = radius});
}

double ball_volume(double radius) {
  return 4.0 / 3.0 * kPi * radius * radius * radius;
}

/// So many markers in a ball.
Markers markers_in_ball(int count, double radius, std::uint64_t seed, double reach,
                        const Vec3& center = Vec3(0.0)) {
  const double volume = ball_volume(radius);
  return Markers(ball(radius, center), volume, count / volume, seed, reach);
}

Vec3 random_point(Rng& random, const Vec3& center, double spread) {
  const double x = random.uniform(-spread, spread);
  const double y = random.uniform(-spread, spread);
  const double z = random.uniform(-spread, spread);
  return center + Vec3(x, y, z);
}

std::vector<Vec3> random_points(std::uint64_t seed, std::size_t count, const Vec3& center, double spread) {
  Rng random = Rng::stream(seed, Stream::dart, 0);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(random_point(random, center, spread));
  return points;
}

struct Sight {
  double radius;
  double min_cosine;
};

std::vector<Seeker> random_seekers(std::uint64_t seed, std::size_t count, const Vec3& center, double spread,
                                   const Sight& sight) {
  Rng random = Rng::stream(seed, Stream::bud, 0);
  std::vector<Seeker> seekers;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 position = random_point(random, center, spread);
    const Vec3 direction = normalized_or(random_point(random, Vec3(0.0), 1.0), kUp);
    seekers.push_back({position, direction, sight.radius, sight.min_cosine});
  }
  // Directions along the axes are a special case of every box.
  for (std::size_t i = 0; i < std::min<std::size_t>(6, count); ++i) {
    seekers[i].direction = Vec3(0.0);
    seekers[i].direction[static_cast<int>(i / 2)] = i % 2 == 0 ? 1.0 : -1.0;
  }
  return seekers;
}

/// The same by the definition, one marker and seeker at a time.
std::vector<Claim> brute_force(const std::vector<Vec3>& markers, const std::vector<Seeker>& seekers) {
  std::vector<Claim> claims(seekers.size());
  std::vector<Vec3> sums(seekers.size(), Vec3(0.0));
  for (const Vec3& marker : markers) {
    std::size_t owner = seekers.size();
    float nearest = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < seekers.size(); ++i) {
      const Vec3 to_marker = marker - seekers[i].position;
      const double distance = glm::length(to_marker);
      if (distance > seekers[i].radius) continue;
      if (glm::dot(to_marker, seekers[i].direction) < (seekers[i].min_cosine - 1e-9) * distance) continue;
      const auto square = static_cast<float>(glm::dot(to_marker, to_marker));
      if (square >= nearest) continue;
      nearest = square;
      owner = i;
    }
    if (owner == seekers.size()) continue;
    ++claims[owner].markers;
    sums[owner] += normalized_or(marker - seekers[owner].position, Vec3(0.0), 1e-300);
  }
  for (std::size_t i = 0; i < seekers.size(); ++i) {
    claims[i].direction = normalized_or(sums[i], seekers[i].direction);
  }
  return claims;
}

std::vector<Claim> claim(Markers& markers, const std::vector<Seeker>& seekers) {
  std::vector<Claim> claims;
  markers.claim(seekers, claims);
  return claims;
}

/// How many claims differ.
std::size_t faults(const std::vector<Claim>& claims, const std::vector<Claim>& expected,
                   double tolerance = 1e-9) {
  REQUIRE(claims.size() == expected.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    count += claims[i].markers != expected[i].markers ||
             !(glm::distance(claims[i].direction, expected[i].direction) <= tolerance);
  }
  return count;
}

std::size_t claimed(const std::vector<Claim>& claims) {
  std::size_t count = 0;
  for (const Claim& claim : claims) count += claim.markers;
  return count;
}

using PointSet = std::set<std::array<double, 3>>;

PointSet as_set(const std::vector<Vec3>& points) {
  PointSet set;
  for (const Vec3& point : points) set.insert({point.x, point.y, point.z});
  return set;
}

}  // namespace

TEST_CASE("markers: a seeker gets what is in its cone, and where that is") {
  Markers markers = markers_in_ball(1, 1.0, 1, 2.0);
  const Vec3 marker = markers.layer().points.front();
  const Vec3 side = any_perpendicular(kUp);
  const double edge = std::cos(radians(45.0));

  const auto seen_from = [&](const Vec3& direction, double distance, double radius, double min_cosine) {
    const Seeker seeker{marker - distance * normalized_or(direction, kUp), kUp, radius, min_cosine};
    const Claim found = claim(markers, {seeker}).front();
    CHECK(glm::distance(found.direction, found.markers == 1 ? glm::normalize(direction) : kUp) < 1e-9);
    return found.markers == 1;
  };
  CHECK(seen_from(kUp, 0.99, 1.0, edge));
  CHECK_FALSE(seen_from(kUp, 1.01, 1.0, edge));
  CHECK(seen_from(kUp + side, 0.7, 1.0, edge));
  CHECK(seen_from(kUp + 0.99 * side, 0.7, 1.0, edge));
  CHECK_FALSE(seen_from(kUp + 1.01 * side, 0.7, 1.0, edge));
  CHECK_FALSE(seen_from(-kUp, 0.5, 1.0, edge));
  CHECK_FALSE(seen_from(-kUp + 0.1 * side, 0.5, 1.0, 0.0));
  CHECK(seen_from(side, 0.5, 1.0, 0.0));
  CHECK(seen_from(-kUp, 0.5, 1.0, -1.0));
}

TEST_CASE(
    "markers: every marker goes to the nearest seeker that sees it, whatever the cone and the density") {
  struct Family {
    int markers;
    int seekers;
    double radius;
    double theta_deg;
  };
  const std::array families = {
      Family{2000, 300, 0.3, 90.0},  Family{2000, 300, 0.5, 360.0}, Family{2000, 300, 0.4, 200.0},
      Family{2000, 300, 0.5, 20.0},  Family{2000, 300, 0.5, 0.0},   Family{20000, 100, 0.2, 90.0},
      Family{20, 300, 0.5, 120.0},   Family{300, 2000, 0.5, 90.0},  Family{2000, 100, 3.0, 90.0},
      Family{2000, 300, 0.02, 90.0},
  };
  for (const Family& family : families) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      INFO(family.markers << " markers, radius " << family.radius << ", theta " << family.theta_deg);
      // The reach is the radius and, for other seeds, more than that.
      const double reach = family.radius * (1.0 + 0.6 * static_cast<double>(seed));
      Markers markers = markers_in_ball(family.markers, 1.0, seed, reach);
      const double min_cosine = std::cos(radians(family.theta_deg / 2.0));
      const std::vector<Seeker> seekers =
          random_seekers(seed, family.seekers, Vec3(0.0), 1.2, {family.radius, min_cosine});
      const std::vector<Claim> claims = claim(markers, seekers);
      const std::vector<Claim> expected = brute_force(markers.layer().points, seekers);
      CHECK(faults(claims, expected) == 0);
      if (family.theta_deg > 0.0 && family.radius > 0.1) CHECK(claimed(claims) > 0);
    }
  }
}

TEST_CASE("markers: seekers that see differently far and wide compete for the same markers") {
  Markers markers = markers_in_ball(3000, 1.0, 8, 0.6);
  std::vector<Seeker> seekers;
  for (const Sight& sight : {Sight{0.6, 0.7}, Sight{0.2, -1.0}, Sight{0.4, 0.0}, Sight{0.0, 0.5}}) {
    const auto more = random_seekers(seekers.size(), 100, Vec3(0.0), 1.0, sight);
    seekers.insert(seekers.end(), more.begin(), more.end());
  }
  CHECK(faults(claim(markers, seekers), brute_force(markers.layer().points, seekers)) == 0);
}

TEST_CASE("markers: a claim leaves nothing behind for the next") {
  Markers markers = markers_in_ball(3000, 1.0, 5, 0.5);
  std::vector<Claim> claims;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const std::vector<Seeker> seekers =
        random_seekers(seed, seed == 2 ? 10 : 1000, Vec3(0.0), 1.0, {0.4, 0.7});
    markers.claim(seekers, claims);
    CHECK(faults(claims, brute_force(markers.layer().points, seekers)) == 0);
    markers.occupy(random_points(seed, 30, Vec3(0.0), 1.0), 0.1);
  }
}

TEST_CASE("markers: of seekers equally far the lower number gets the marker") {
  Markers markers = markers_in_ball(1, 1.0, 3, 1.0);
  const Vec3 marker = markers.layer().points.front();
  const auto winner = [&](const std::vector<Seeker>& seekers) {
    const std::vector<Claim> claims = claim(markers, seekers);
    REQUIRE(claimed(claims) == 1);
    const auto has_it = [](const Claim& claim) { return claim.markers == 1; };
    return std::find_if(claims.begin(), claims.end(), has_it) - claims.begin();
  };

  Rng random = Rng::stream(4, Stream::bud, 0);
  for (int i = 0; i < 200; ++i) {
    const Vec3 away = random_point(random, Vec3(0.0), 0.5);
    const Vec3 inwards = -normalized_or(away, kUp);
    const Seeker near{marker + 0.5 * away, inwards, 1.0, 0.0};
    const Seeker one{marker + away, inwards, 1.0, 0.0};
    const Seeker mirrored{marker - away, -inwards, 1.0, 0.0};
    const Seeker blind{marker + away, -inwards, 1.0, 0.0};
    CHECK(winner({one, one, one}) == 0);
    CHECK(winner({one, mirrored}) == 0);
    CHECK(winner({mirrored, one}) == 0);
    CHECK(winner({blind, mirrored, one, mirrored}) == 1);
    CHECK(winner({mirrored, one, near}) == 2);
  }
}

TEST_CASE("markers: a marker where the seeker stands is its own and points nowhere") {
  Markers markers = markers_in_ball(1, 1.0, 1, 1.0);
  const Vec3 direction = glm::normalize(Vec3(1.0, 2.0, 3.0));
  const Claim found = claim(markers, {{markers.layer().points.front(), direction, 0.5, 0.9}}).front();
  CHECK(found.markers == 1);
  CHECK(found.direction == direction);
}

TEST_CASE("markers: occupying takes those within the radius, no others, and for good") {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Markers markers = markers_in_ball(5000, 1.0, seed, 0.3);
    for (const double radius : {0.05, 0.0, 0.2, 0.6}) {
      const std::vector<Vec3> points = random_points(seed, 15, Vec3(0.0), 1.1);
      PointSet expected;
      for (const Vec3& marker : markers.layer().points) {
        const bool is_taken = std::any_of(points.begin(), points.end(), [&](const Vec3& point) {
          return glm::distance(point, marker) <= radius;
        });
        if (!is_taken) expected.insert({marker.x, marker.y, marker.z});
      }
      markers.occupy(points, radius);
      CHECK(as_set(markers.layer().points) == expected);
      CHECK(markers.count() == expected.size());
    }
    CHECK(markers.count() < 5000);
    const std::vector<Seeker> seekers = random_seekers(seed, 200, Vec3(0.0), 1.0, {0.3, 0.5});
    CHECK(faults(claim(markers, seekers), brute_force(markers.layer().points, seekers)) == 0);

    markers.occupy(std::vector<Vec3>{Vec3(0.0)}, 1.0 + 1e-6);
    CHECK(markers.count() == 0);
    CHECK(claimed(claim(markers, seekers)) == 0);
  }
}

TEST_CASE("markers: what is left does not depend on the order of the points that occupy") {
  std::vector<Vec3> points = random_points(7, 100, Vec3(0.0), 1.0);
  Markers forward = markers_in_ball(5000, 1.0, 7, 0.3);
  forward.occupy(points, 0.15);
  std::reverse(points.begin(), points.end());
  Markers backward = markers_in_ball(5000, 1.0, 7, 0.3);
  for (const Vec3& point : points) backward.occupy(std::vector<Vec3>{point}, 0.15);
  CHECK(forward.layer().points == backward.layer().points);
}

TEST_CASE("markers: no place with a marker in reach is called barren, and none far from all is not") {
  for (const double reach : {0.05, 0.2, 1.0}) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      INFO("reach " << reach);
      const Vec3 center(3.0, -4.0, 5.0);
      Markers markers = markers_in_ball(20000, 1.0, seed, reach, center);
      for (int round = 0; round < 4; ++round) {
        const std::vector<Vec3> left = markers.layer().points;
        std::size_t wrong = 0;
        for (const Vec3& point : random_points(seed + 50, 300, center, 1.0 + 2.0 * reach)) {
          double nearest = std::numeric_limits<double>::infinity();
          for (const Vec3& marker : left) nearest = std::min(nearest, glm::distance(point, marker));
          wrong += markers.is_barren(point) && nearest <= reach;
          // Where there are several markers to a cell, three cells are not twice as wide as the reach.
          if (reach >= 0.2) wrong += !markers.is_barren(point) && nearest > 3.5 * reach;
        }
        CHECK(wrong == 0);
        // From marker to marker the distance is often just the reach.
        for (const Vec3& marker : left) {
          wrong += markers.is_barren(marker + Vec3(reach, 0, 0)) || markers.is_barren(marker - kUp * reach);
        }
        CHECK(wrong == 0);
        markers.occupy(random_points(seed + 60 + round, 40, center, 1.0), 0.3);
      }
      markers.occupy(std::vector<Vec3>{center}, 1.1);
      CHECK(markers.is_barren(center));
    }
  }
}

TEST_CASE("markers: any number of threads makes the same claims") {
  Markers markers = markers_in_ball(30000, 1.0, 11, 0.4);
  const std::vector<Seeker> seekers = random_seekers(11, 5000, Vec3(0.0), 1.0, {0.3, 0.7});
  std::vector<std::vector<Claim>> results;
  std::vector<PointLayer> layers;
  for (const int threads : {1, 2, 2, 1}) {
    const ThreadLimit limit(threads);
    results.push_back(claim(markers, seekers));
    layers.push_back(markers_in_ball(30000, 1.0, 11, 0.4).layer());
    CHECK(faults(results.back(), results.front(), 0.0) == 0);
    CHECK(layers.back().points == layers.front().points);
  }
  CHECK(claimed(results.front()) > 20000);
}

TEST_CASE("markers: a density makes density times volume, evenly spread inside the solid") {
  const Solid solid({.shape = Shape::cone, .center = {1, 2, 3}, .radius = 2.0, .height = 3.0});
  const double volume = 4.0 * kPi;
  for (const double density : {0.1, 3.3, 1000.0}) {
    const Markers markers(solid, volume, density, 1, 0.5);
    const std::vector<Vec3> points = markers.layer().points;
    CHECK(markers.count() == static_cast<std::size_t>(std::lround(density * volume)));
    CHECK(points.size() == markers.count());
    CHECK(as_set(points).size() == points.size());
    CHECK(std::all_of(points.begin(), points.end(), [&](const Vec3& p) { return solid.contains(p); }));
  }

  // The lower half of the height holds 7 of 8, one side of the axis half.
  const std::vector<Vec3> points = Markers(solid, volume, 1000.0, 1, 0.5).layer().points;
  const auto share = [&](const auto& is_there) {
    return static_cast<double>(std::count_if(points.begin(), points.end(), is_there)) /
           static_cast<double>(points.size());
  };
  CHECK(std::abs(share([](const Vec3& p) { return p.y < 3.5; }) - 0.875) < 0.01);
  CHECK(std::abs(share([](const Vec3& p) { return p.x < 1.0; }) - 0.5) < 0.015);
  CHECK(std::abs(share([](const Vec3& p) { return p.z < 3.0; }) - 0.5) < 0.015);
}

TEST_CASE("markers: the seed says where they are, and a higher density adds to them") {
  const auto points = [](int count, std::uint64_t seed, double reach) {
    return as_set(markers_in_ball(count, 1.0, seed, reach).layer().points);
  };
  CHECK(points(500, 1, 0.3) == points(500, 1, 0.3));
  CHECK(points(500, 1, 0.3) == points(500, 1, 0.1));
  CHECK(points(500, 1, 0.3) != points(500, 2, 0.3));
  const PointSet few = points(500, 1, 0.3);
  const PointSet many = points(800, 1, 0.3);
  CHECK(std::includes(many.begin(), many.end(), few.begin(), few.end()));
}

TEST_CASE("markers: a solid far from the origin is as good as one about it") {
  for (const Vec3& center : {Vec3(900.0, -800.0, 700.0), Vec3(-1e6, 1e6, 1e6)}) {
    Markers markers = markers_in_ball(3000, 1.0, 1, 0.4, center);
    const std::vector<Vec3> points = markers.layer().points;
    CHECK(as_set(points).size() == 3000);
    const Solid solid = ball(1.0, center);
    CHECK(std::all_of(points.begin(), points.end(), [&](const Vec3& p) { return solid.contains(p); }));
    const std::vector<Seeker> seekers = random_seekers(1, 300, center, 1.2, {0.4, 0.7});
    CHECK(faults(claim(markers, seekers), brute_force(points, seekers), 1e-6) == 0);
  }
}

TEST_CASE("markers: seekers outside the box see in, those far away see nothing") {
  Markers markers = markers_in_ball(3000, 1.0, 2, 0.5);
  std::vector<Seeker> seekers;
  for (Seeker seeker : random_seekers(2, 2000, Vec3(0.0), 1.6, {0.5, 0.7})) {
    if (glm::all(glm::lessThan(glm::abs(seeker.position), Vec3(1.0)))) continue;
    seeker.direction = -glm::normalize(seeker.position);
    seekers.push_back(seeker);
  }
  seekers.push_back({Vec3(0.0, -1e9, 0.0), kUp, 0.5, 0.7});
  seekers.push_back({Vec3(1e300, 0.0, 0.0), kUp, 0.5, 0.7});
  const std::vector<Claim> claims = claim(markers, seekers);
  CHECK(claimed(claims) > 100);
  CHECK(faults(claims, brute_force(markers.layer().points, seekers)) == 0);
  CHECK(markers.is_barren(seekers.back().position));
}

TEST_CASE("markers: where there are none, all is barren and every seeker keeps its direction") {
  const Solid solid = ball(1.0);
  for (const double density : {0.0, 0.1}) {
    Markers markers(solid, ball_volume(1.0), density, 1, 0.5);
    CHECK(markers.count() == 0);
    CHECK(markers.layer().points.empty());
    CHECK(markers.is_barren(Vec3(0.0)));
    markers.occupy(std::vector<Vec3>{Vec3(0.0), Vec3(9.0)}, 0.5);
    const std::vector<Seeker> seekers = random_seekers(1, 10, Vec3(0.0), 1.0, {0.5, 0.5});
    CHECK(faults(claim(markers, seekers), brute_force({}, seekers), 0.0) == 0);
    CHECK(claim(markers, {}).empty());
  }
}

TEST_CASE("markers: a few in a huge box take little memory and are found") {
  Markers markers = markers_in_ball(100, 1000.0, 1, 0.01);
  const std::vector<Vec3> points = markers.layer().points;
  std::vector<Seeker> seekers;
  for (const Vec3& point : points) seekers.push_back({point - 0.009 * kUp, kUp, 0.01, 0.5});
  CHECK(claimed(claim(markers, seekers)) == 100);
  markers.occupy(points, 0.001);
  CHECK(markers.count() == 0);
  CHECK(markers.is_barren(points.front()));
}

TEST_CASE("markers: too many, or a solid without an inside, is an error that says so") {
  const auto message = [](const Solid& solid, double density) -> std::string {
    try {
      Markers(solid, 1.0, density, 1, 0.5);
    } catch (const RunError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(message(ball(1.0), 1e12) ==
        "markers: 1e+12 of them (at most 2.68e+08; less density or a smaller volume)");
  const Solid nothing({.shape = Shape::union_of});
  CHECK(message(nothing, 1.0) ==
        "marker 0: none of 10000000 points in the volume's box is inside it (a volume that fills more of its "
        "box)");
}
