#include "tests/common/solids.h"

#include "common/base/errors.h"

#include <numbers>

#include "common/base/rng.h"
#include "tests/catch.h"

namespace ramify::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// A share of balls of radius 1 whose centres are 1 apart.
constexpr double kLens = kPi * 5.0 / 12.0;

}  // namespace

const std::vector<Vec3>& tilts() {
  static const std::vector<Vec3> directions = {{0, 1, 0}, {0, -2, 0},     {1, 0, 0},
                                               {1, 1, 0}, {-0.3, 0.5, 2}, {3, -1, 1}};
  return directions;
}

std::vector<KnownVolume> known_shapes() {
  std::vector<KnownVolume> known = {
      {"sphere", {.shape = Shape::sphere, .center = {1, 2, 3}, .radius = 2}, 4.0 / 3 * kPi * 8},
      {"ellipsoid", {.shape = Shape::ellipsoid, .center = {0, 5, 0}, .radii = {1, 2, 3}}, 4.0 / 3 * kPi * 6},
      {"box", {.shape = Shape::box, .center = {1, 0, -2}, .size = {1, 2, 3}}, 6},
  };
  for (const Vec3& direction : tilts()) {
    known.push_back({"cylinder",
                     {.shape = Shape::cylinder, .radius = 0.5, .height = 3, .direction = direction},
                     kPi * 0.25 * 3});
    known.push_back(
        {"cone",
         {.shape = Shape::cone, .center = {-1, 0, 2}, .radius = 1, .height = 3, .direction = direction},
         kPi});
    known.push_back({"hemisphere",
                     {.shape = Shape::hemisphere, .center = {0, 4, 0}, .radius = 2, .direction = direction},
                     2.0 / 3 * kPi * 8});
    for (const double angle : {25.0, 60.0, 90.0, 135.0, 180.0}) {
      known.push_back(
          {"sphere_portion " + std::to_string(angle),
           {.shape = Shape::sphere_portion, .radius = 2, .angle_deg = angle, .direction = direction},
           2.0 / 3 * kPi * 8 * (1 - std::cos(radians(angle)))});
    }
    known.push_back({"revolution of a triangle",
                     {.shape = Shape::revolution,
                      .center = {-1, 0, 2},
                      .direction = direction,
                      .points = {{1, 0}, {0, 3}}},
                     kPi});
    known.push_back({"revolution of a rectangle",
                     {.shape = Shape::revolution, .direction = direction, .points = {{0.5, 0}, {0.5, 3}}},
                     kPi * 0.25 * 3});
    known.push_back(
        {"spindle",
         {.shape = Shape::revolution, .direction = direction, .points = {{0, -1}, {1, 1}, {0, 3}}},
         kPi * 4 / 3});
    known.push_back({"ring",
                     {.shape = Shape::revolution,
                      .direction = direction,
                      .points = {{1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 0}}},
                     kPi * 3});
  }
  return known;
}

std::vector<KnownVolume> known_compositions() {
  const Volume ball{.shape = Shape::sphere};
  const Volume other{.shape = Shape::sphere, .center = {1, 0, 0}};
  const Volume far{.shape = Shape::sphere, .center = {3, 0, 0}};
  const Volume small{.shape = Shape::sphere, .radius = 0.8};
  const Volume rod{.shape = Shape::cylinder, .center = {0, -3, 0}, .radius = 0.5, .height = 6};
  const Volume block{.shape = Shape::box, .size = {2, 2, 2}};
  const double one = 4.0 / 3 * kPi;
  return {
      {"stretched and turned sphere",
       {.shape = Shape::sphere, .center = {0, 1, 0}, .scale = {1, 2, 3}, .rotate = {20, 30, 40}},
       one * 6},
      {"grown and turned ellipsoid",
       {.shape = Shape::ellipsoid,
        .radii = {1, 2, 3},
        .scale = {0.5, 0.5, 0.5},
        .rotate = {0, 90, 45},
        .translate = {1, 2, 3}},
       one * 6 / 8},
      {"turned box",
       {.shape = Shape::box,
        .center = {1, 0, 0},
        .size = {1, 2, 3},
        .scale = {2, 1, 0.5},
        .rotate = {30, 40, 50},
        .translate = {5, 0, 0}},
       6},
      {"moved cone",
       {.shape = Shape::cone, .height = 3, .scale = {2, 2, 2}, .rotate = {90, 0, 0}, .translate = {0, 0, -7}},
       kPi * 8},
      {"flattened leaning cylinder",
       {.shape = Shape::cylinder, .radius = 0.5, .height = 3, .direction = {1, 1, 0}, .scale = {2, 1, 0.5}},
       kPi * 0.25 * 3},
      {"flattened bowl",
       {.shape = Shape::sphere_portion,
        .radius = 2,
        .angle_deg = 135,
        .direction = {1, 1, 0},
        .scale = {2, 1, 0.5}},
       2.0 / 3 * kPi * 8 * (1 + std::sqrt(0.5))},
      {"grown leaning ring",
       {.shape = Shape::revolution,
        .direction = {1, 0, 0},
        .points = {{1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 0}},
        .scale = {0.5, 0.5, 0.5},
        .rotate = {0, 0, 30},
        .translate = {1, 1, 1}},
       kPi * 3 / 8},
      {"flattened spindle",
       {.shape = Shape::revolution, .points = {{0, -1}, {1, 1}, {0, 3}}, .scale = {1, 0.5, 2}},
       kPi * 4 / 3},
      {"stretched union of turned shapes",
       {.shape = Shape::union_of,
        .scale = {1, 2, 1},
        .rotate = {0, 0, 30},
        .parts = {{.shape = Shape::box, .rotate = {10, 20, 30}},
                  {.shape = Shape::cylinder, .center = {4, 0, 0}, .height = 2, .direction = {1, 0, 1}}}},
       2 + 4 * kPi},
      {"shell", {.shape = Shape::difference, .parts = {ball, small}}, one * (1 - 0.8 * 0.8 * 0.8)},
      {"bitten ball", {.shape = Shape::difference, .parts = {ball, other, far}}, one - kLens},
      {"lens", {.shape = Shape::intersection, .parts = {ball, other}}, kLens},
      {"turned lens",
       {.shape = Shape::intersection,
        .scale = {2, 2, 2},
        .rotate = {0, 40, 0},
        .translate = {0, 5, 0},
        .parts = {ball, other}},
       8 * kLens},
      {"drilled block", {.shape = Shape::difference, .parts = {block, rod}}, 8 - 2 * kPi * 0.25},
      {"frame",
       {.shape = Shape::difference, .parts = {block, {.shape = Shape::box, .size = {1.98, 4, 1.98}}}},
       8 - 2 * 1.98 * 1.98},
      {"wall with two holes, cut off",
       {.shape = Shape::intersection,
        .parts = {{.shape = Shape::difference,
                   .parts = {{.shape = Shape::box, .size = {8, 8, 0.1}},
                             {.shape = Shape::union_of,
                              .parts = {{.shape = Shape::cylinder,
                                         .center = {-1, 0, -1},
                                         .radius = 0.5,
                                         .height = 2,
                                         .direction = {0, 0, 1}},
                                        {.shape = Shape::cylinder,
                                         .center = {1, 0, -1},
                                         .radius = 0.5,
                                         .height = 2,
                                         .direction = {0, 0, 1}}}}}},
                  {.shape = Shape::box, .size = {4, 2, 4}}}},
       0.1 * (8 - 2 * kPi * 0.25)},
      {"two balls and a lens",
       {.shape = Shape::union_of,
        .parts = {far,
                  {.shape = Shape::sphere, .center = {3, 3, 0}},
                  {.shape = Shape::intersection, .parts = {ball, other}}}},
       2 * one + kLens},
  };
}

std::vector<KnownVolume> known_volumes() {
  std::vector<KnownVolume> known = known_shapes();
  for (KnownVolume& composition : known_compositions()) known.push_back(std::move(composition));
  return known;
}

std::vector<Vec3> points_around(const Volume& volume, std::uint64_t count) {
  const Box box = bounds(volume);
  std::vector<Vec3> points;
  for (std::uint64_t i = 0; i < count; ++i) {
    Rng rng = Rng::stream(7, Stream::dart, i);
    const double x = rng.uniform(-0.1, 1.1);
    const double y = rng.uniform(-0.1, 1.1);
    const double z = rng.uniform(-0.1, 1.1);
    points.push_back(box.low + Vec3(x, y, z) * box.size());
  }
  return points;
}

void check_meets(const Volume& volume, double tolerance) {
  constexpr int kSamples = 400;
  const Solid solid(volume);
  const std::vector<Vec3> points = points_around(volume, 800);
  int met_count = 0;
  int missed_count = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    // Short ones and long ones.
    const Vec3 from = points[i - 1];
    const Vec3 to = i % 2 == 0 ? points[i] : from + 0.1 * (points[i] - from);
    const double gap = glm::distance(from, to) / kSamples;
    bool is_inside_somewhere = false;
    bool is_near_somewhere = false;
    for (int k = 0; k <= kSamples; ++k) {
      const Vec3 point = from + static_cast<double>(k) / kSamples * (to - from);
      is_inside_somewhere = is_inside_somewhere || solid.contains(point);
      is_near_somewhere = is_near_somewhere || !solid.is_farther(point, 0.5 * gap + tolerance);
    }
    const bool is_met = solid.meets(from, to);
    ++(is_met ? met_count : missed_count);
    INFO("from " << from.x << ' ' << from.y << ' ' << from.z << " to " << to.x << ' ' << to.y << ' ' << to.z);
    if (is_inside_somewhere) REQUIRE(is_met);
    if (is_met) REQUIRE(is_near_somewhere);
    REQUIRE(is_met == solid.meets(to, from));
    if (solid.contains(from)) REQUIRE(solid.meets(from, from));
  }
  // Both happened: the segments say something.
  CHECK(met_count > 50);
  CHECK(missed_count > 50);
}

bool is_near(double value, double expected, double tolerance) {
  INFO(value << " instead of " << expected);
  CHECK(std::abs(value - expected) <= tolerance);
  return std::abs(value - expected) <= tolerance;
}

std::string problem_of(const std::string& key, const Volume& volume) {
  try {
    check_volume(volume, key);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return {};
}

}  // namespace ramify::test
