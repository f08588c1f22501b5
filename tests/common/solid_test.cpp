// Boxes, differences, intersections, transforms, and segments that meet a solid.

#include <algorithm>
#include <numbers>
#include <string>

#include "common/base/errors.h"
#include "common/config/toml_reader.h"
#include "common/config/toml_writer.h"
#include "common/volume/solid.h"
#include "tests/catch.h"
#include "tests/common/solids.h"

using namespace ramify;
using ramify::test::check_meets;
using ramify::test::is_near;
using ramify::test::known_compositions;
using ramify::test::known_shapes;
using ramify::test::known_volumes;
using ramify::test::KnownVolume;
using ramify::test::points_around;
using ramify::test::problem_of;

namespace {

constexpr double kPi = std::numbers::pi;

/// The share of points on which two volumes differ.
double difference_of(const Volume& a, const Volume& b) {
  int count = 0;
  const std::vector<Vec3> points = points_around(a, 20'000);
  for (const Vec3& point : points) count += contains(a, point) != contains(b, point);
  return count / static_cast<double>(points.size());
}

Volume from_toml(const std::string& text) {
  Volume volume;
  Origins origins;
  TomlDocument(text, "crown.toml").read_into(Volume::fields(), &volume, {}, origins);
  return volume;
}

}  // namespace

TEST_CASE("solid: a box's center is its middle and its size its edges") {
  const Volume box{.shape = Shape::box, .center = {1, 2, 3}, .size = {2, 4, 6}};
  CHECK(contains(box, {0, 0, 0}));
  CHECK(contains(box, {2, 4, 6}));
  CHECK_FALSE(contains(box, {2.001, 2, 3}));
  CHECK_FALSE(contains(box, {1, -0.001, 3}));
  CHECK(bounds(box).low == Vec3(0, 0, 0));
  CHECK(bounds(box).high == Vec3(2, 4, 6));
}

TEST_CASE("solid: a stretched sphere is an ellipsoid, a stretched box a box") {
  const Volume sphere{.shape = Shape::sphere, .center = {1, 0, 0}, .radius = 2, .scale = {0.5, 1, 1.5}};
  const Volume ellipsoid{.shape = Shape::ellipsoid, .center = {0.5, 0, 0}, .radii = {1, 2, 3}};
  CHECK(difference_of(sphere, ellipsoid) == 0.0);
  for (const Vec3& point : points_around(ellipsoid, 300)) {
    CHECK(is_near(outer_depth(sphere, point), outer_depth(ellipsoid, point), 1e-12));
  }
  const Volume cube{.shape = Shape::box, .center = {1, 1, 1}, .scale = {1, 2, 3}};
  const Volume box{.shape = Shape::box, .center = {1, 2, 3}, .size = {1, 2, 3}};
  CHECK(difference_of(cube, box) == 0.0);
}

TEST_CASE("solid: scaled first, then turned about x, y and z in that order, then moved") {
  // A tiny ball marks a point.
  const auto goes_to = [](const Volume& marked, const Vec3& place) {
    return contains(marked, place) && is_near(glm::distance(bounds(marked).center(), place), 0.0, 1e-9);
  };
  Volume ball{.shape = Shape::sphere, .center = {1, 0, 0}, .radius = 0.01};
  ball.rotate = {0, 0, 90};
  CHECK(goes_to(ball, {0, 1, 0}));
  ball.rotate = {90, 0, 90};  // x leaves it on its axis
  CHECK(goes_to(ball, {0, 1, 0}));
  ball.rotate = {0, 90, 90};  // y takes it to -z, which z leaves there; the other way round it would be at y
  CHECK(goes_to(ball, {0, 0, -1}));
  ball.center = {0, 1, 0};
  ball.rotate = {90, 90, 0};  // x takes it to z, y that to x
  CHECK(goes_to(ball, {1, 0, 0}));
  ball.scale = {1, 3, 1};
  CHECK(goes_to(ball, {3, 0, 0}));
  ball.translate = {0.5, 0, 7};
  CHECK(goes_to(ball, {3.5, 0, 7}));
}

TEST_CASE("solid: a transform of a union is one of each part, and transforms nest") {
  const Volume part{.shape = Shape::cone, .center = {1, 0, 0}, .radius = 0.5, .height = 2};
  Volume moved = part;
  moved.scale = {2, 2, 2};
  moved.rotate = {0, 0, 90};
  moved.translate = {3, 0, 0};
  const Volume inner{
      .shape = Shape::union_of, .rotate = {0, 0, 90}, .translate = {1.5, 0, 0}, .parts = {part}};
  const Volume outer{.shape = Shape::union_of, .scale = {2, 2, 2}, .parts = {inner}};
  CHECK(difference_of(moved, outer) == 0.0);
  CHECK(difference_of(outer, moved) == 0.0);
  const Box a = bounds(moved);
  const Box b = bounds(outer);
  CHECK(is_near(glm::distance(a.low, b.low) + glm::distance(a.high, b.high), 0.0, 1e-12));
  // A cone of height 4 along -x, whose base of radius 1 is at (3, 2, 0).
  CHECK(contains(outer, {3, 2.9, 0}));
  CHECK(contains(outer, {-0.9, 2, 0}));
  CHECK_FALSE(contains(outer, {-1.1, 2, 0}));
}

TEST_CASE("solid: any transform of a shape is the shape of the points that are carried back") {
  // What the transform does, said in another way: turned by three rotations, one after another.
  const auto carried = [](const Volume& v, Vec3 point) {
    point *= v.scale;
    point = rotated(point, {1, 0, 0}, radians(v.rotate.x));
    point = rotated(point, {0, 1, 0}, radians(v.rotate.y));
    point = rotated(point, {0, 0, 1}, radians(v.rotate.z));
    return point + v.translate;
  };
  for (const KnownVolume& known : known_shapes()) {
    INFO(known.name);
    for (const Vec3& scale : {Vec3(1, 1, 1), Vec3(2, 2, 2), Vec3(0.5, 1, 3)}) {
      for (const Vec3& turned : {Vec3(0, 0, 0), Vec3(20, -70, 130)}) {
        Volume volume = known.volume;
        volume.scale = scale;
        volume.rotate = turned;
        volume.translate = {1, -2, 0.5};
        const Solid plain(known.volume);
        const Solid placed(volume);
        for (const Vec3& point : points_around(known.volume, 300)) {
          REQUIRE(placed.contains(carried(volume, point)) == plain.contains(point));
        }
      }
    }
  }
}

TEST_CASE("solid: the lens of two balls is the one in the textbook, and the ball without it the rest") {
  const Volume ball{.shape = Shape::sphere};
  const Volume other{.shape = Shape::sphere, .center = {1.2, 0, 0}, .radius = 0.7};
  const double d = 1.2;
  const double r = 0.7;
  const double lens =
      kPi * (1 + r - d) * (1 + r - d) * (d * d + 2 * d * r - 3 * r * r + 2 * d + 6 * r - 3) / (12 * d);
  const Volume both{.shape = Shape::intersection, .parts = {ball, other}};
  const Volume rest{.shape = Shape::difference, .parts = {ball, other}};
  CHECK(is_near(volume_of(both, 2'000'000), lens, 0.002 * lens));
  CHECK(is_near(volume_of(rest, 2'000'000), 4.0 / 3 * kPi - lens, 0.005));
  CHECK(is_near(shared_volume_of(ball, other, 2'000'000), lens, 0.002 * lens));
  CHECK(shared_volume_of(both, rest) < 1e-6);
}

TEST_CASE("solid: what is cut off keeps the face of the cut") {
  const Volume ball{.shape = Shape::sphere, .radius = 2};
  const Volume hole{.shape = Shape::sphere, .radius = 1};
  const Volume shell{.shape = Shape::difference, .parts = {ball, hole}};
  CHECK(contains(shell, {1, 0, 0}));
  CHECK_FALSE(contains(shell, {0.999, 0, 0}));
  CHECK(contains(shell, {2, 0, 0}));
  const Volume nothing{.shape = Shape::intersection,
                       .parts = {hole, {.shape = Shape::box, .center = {5, 0, 0}}}};
  CHECK_FALSE(contains(nothing, {0, 0, 0}));
  CHECK(bounds(nothing).is_empty());
  CHECK(problem_of("crown", nothing).find("crown: nothing inside it") == 0);
  CHECK(problem_of("crown", {.shape = Shape::difference, .parts = {hole, ball}})
            .find("crown: nothing inside it") == 0);
}

TEST_CASE("solid: only what is known to be convex has a number of its own") {
  const Volume ball{.shape = Shape::sphere};
  const Volume other{.shape = Shape::sphere, .center = {1, 0, 0}};
  const Vec3 inside(0.5, 0, 0);
  CHECK(Solid({.shape = Shape::box}).convex_part(Vec3(0)).has_value());
  CHECK(Solid({.shape = Shape::intersection, .parts = {ball, other}}).convex_part(inside).has_value());
  CHECK_FALSE(
      Solid({.shape = Shape::difference, .parts = {ball, other}}).convex_part({-0.5, 0, 0}).has_value());
  const Volume both{.shape = Shape::union_of, .parts = {ball, other}};
  CHECK_FALSE(Solid({.shape = Shape::intersection, .parts = {both, both}}).convex_part(inside).has_value());
}

TEST_CASE("solid: depth is the distance to all faces of a box, also of a turned one") {
  const Volume box{.shape = Shape::box, .center = {0, 1, 0}, .size = {4, 2, 6}};
  CHECK(is_near(outer_depth(box, {0, 1, 0}), 1.0, 1e-12));
  CHECK(is_near(outer_depth(box, {0, 0.1, 0}), 0.1, 1e-12));
  CHECK(is_near(outer_depth(box, {1.8, 1, 0}), 0.2, 1e-12));
  Volume turned = box;
  turned.rotate = {0, 0, 90};  // the middle is at (-1, 0, 0)
  CHECK(is_near(outer_depth(turned, {-0.1, 0, 0}), 0.1, 1e-12));
  CHECK(is_near(outer_depth(turned, {-1, 1.8, 0}), 0.2, 1e-12));
}

TEST_CASE("solid: depth of a difference counts its cuts, of an intersection all that is left") {
  const Volume shell{.shape = Shape::difference,
                     .parts = {{.shape = Shape::sphere, .radius = 2}, {.shape = Shape::sphere, .radius = 1}}};
  CHECK(is_near(outer_depth(shell, {1.2, 0, 0}), 0.2, 1e-9));
  CHECK(is_near(outer_depth(shell, {0, -1.9, 0}), 0.1, 1e-9));
  CHECK(outer_depth(shell, {0.5, 0, 0}) == 0.0);
  const Volume lens{.shape = Shape::intersection,
                    .parts = {{.shape = Shape::sphere}, {.shape = Shape::sphere, .center = {1, 0, 0}}}};
  CHECK(is_near(outer_depth(lens, {0.5, 0, 0}), 0.5, 1e-12));
  CHECK(is_near(outer_depth(lens, {0.2, 0, 0}), 0.2, 1e-12));
  // The flat side of a dome stays no outer face when it is cut.
  const Volume cut{.shape = Shape::difference,
                   .parts = {{.shape = Shape::hemisphere, .radius = 3},
                             {.shape = Shape::box, .center = {5, 0, 0}, .size = {6, 9, 9}}}};
  CHECK(is_near(outer_depth(cut, {0, 0.1, 0}), 2.0, 1e-9));
  // A trunk covers a part of the shell.
  const Volume on_a_trunk{.shape = Shape::union_of,
                          .parts = {shell, {.shape = Shape::cylinder, .center = {0, -9, 0}, .height = 8}}};
  CHECK(is_near(outer_depth(on_a_trunk, {0, 1.9, 0}), 0.1, 1e-9));
  CHECK(outer_depth(on_a_trunk, {0, -1.95, 0}) > 0.1);
}

TEST_CASE("solid: depth in an unevenly scaled part is right at flat faces and near curved ones") {
  const Volume log{.shape = Shape::cylinder, .height = 2, .scale = {3, 0.5, 3}};
  CHECK(is_near(outer_depth(log, {0, 0.9, 0}), 0.1, 1e-12));
  CHECK(is_near(outer_depth(log, {2.9, 0.5, 0}), 0.1, 1e-12));
  const Volume dome{.shape = Shape::hemisphere, .scale = {1, 3, 1}};
  CHECK(is_near(outer_depth(dome, {0, 2.9, 0}), 0.1, 1e-12));
  CHECK(is_near(outer_depth(dome, {0.9, 0.5, 0}), 0.086, 0.005));
}

TEST_CASE("solid: many points asked at once are each in or out as when asked alone") {
  std::vector<Volume> volumes;
  for (const KnownVolume& known : known_volumes()) volumes.push_back(known.volume);
  volumes.push_back({.shape = Shape::union_of, .parts = {volumes.front(), volumes.back()}});
  for (const Volume& volume : volumes) {
    const Solid solid(volume);
    const std::vector<Vec3> points = points_around(volume, 1000);
    std::vector<std::uint8_t> is_inside(points.size(), 7);
    solid.find_inside(points, is_inside);
    std::size_t different = 0;
    for (std::size_t i = 0; i < points.size(); ++i) different += is_inside[i] != solid.contains(points[i]);
    CHECK(different == 0);
    CHECK(std::ranges::count(is_inside, 1) > 0);
  }
}

TEST_CASE("solid: a segment meets a shape exactly where a dense row of points does") {
  for (const KnownVolume& known : known_shapes()) {
    INFO(known.name);
    const bool is_exact = known.volume.shape != Shape::revolution;
    check_meets(known.volume, is_exact ? 1e-9 : 1e-3);
  }
}

TEST_CASE("solid: a segment meets what is scaled, cut off or put together where a row of points does") {
  for (const KnownVolume& known : known_compositions()) {
    INFO(known.name);
    check_meets(known.volume, 1e-3);
  }
}

TEST_CASE("solid: a wall is not jumped, however thin, and a hole in it is free") {
  const Volume sheet{.shape = Shape::box, .size = {4, 4, 1e-6}};
  CHECK(Solid(sheet).meets({0.1, 0.2, -3}, {0.3, 0.1, 5}));
  CHECK_FALSE(Solid(sheet).meets({0.1, 0.2, 1}, {0.3, 0.1, 5}));
  const Volume thick{.shape = Shape::box, .size = {4, 4, 0.001}};
  const Volume holed{.shape = Shape::difference,
                     .parts = {thick,
                               {.shape = Shape::cylinder,
                                .center = {0, 0, -1},
                                .radius = 0.1,
                                .height = 2,
                                .direction = {0, 0, 1}}}};
  const Solid wall(holed);
  CHECK(wall.meets({0.5, 0, -3}, {0.5, 0, 5}));
  CHECK(wall.meets({0.09, 0, -3}, {0.2, 0, 5}));
  CHECK_FALSE(wall.meets({0, 0, -3}, {0, 0, 5}));
  CHECK_FALSE(wall.meets({0.05, 0.05, -0.1}, {-0.05, -0.05, 0.1}));
  const Volume glass{.shape = Shape::revolution,
                     .points = {{0.9999, 0}, {1, 0}, {1, 4}, {0.9999, 4}, {0.9999, 0}}};
  CHECK(Solid(glass).meets({0, 1, 0}, {3, 1, 0}));
  CHECK_FALSE(Solid(glass).meets({0, -1, 0}, {0, 6, 0}));
  CHECK_FALSE(Solid({.shape = Shape::union_of}).meets({0, 0, 0}, {1, 0, 0}));
}

TEST_CASE("solid: a segment that only touches meets, and one of no length is a point") {
  const Solid ball({.shape = Shape::sphere});
  CHECK(ball.meets({-2, 1, 0}, {2, 1, 0}));
  CHECK_FALSE(ball.meets({-2, 1.000001, 0}, {2, 1.000001, 0}));
  CHECK(ball.meets({0, 0, 0}, {0.1, 0, 0}));  // wholly inside
  CHECK(ball.meets({1, 0, 0}, {1, 0, 0}));
  CHECK_FALSE(ball.meets({1.1, 0, 0}, {1.1, 0, 0}));
  const Solid cone({.shape = Shape::cone});
  CHECK(cone.meets({-1, 1, 0}, {1, 1, 0}));  // its tip
  CHECK_FALSE(cone.meets({-1, 1.000001, 0}, {1, 1.000001, 0}));
  CHECK(cone.meets({1, 0, -1}, {1, 0, 1}));  // the rim of its base
}

TEST_CASE("solid: parts that are missing and scales of zero are named") {
  CHECK(problem_of("crown", {.shape = Shape::difference}) ==
        "crown: a difference without parts (at least one part)");
  CHECK(problem_of("crown", {.shape = Shape::intersection}) ==
        "crown: an intersection without parts (at least one part)");
  CHECK(problem_of("crown", {.shape = Shape::difference,
                             .parts = {{.shape = Shape::sphere}, {.shape = Shape::union_of}}}) ==
        "crown.parts.2: a union without parts (at least one part)");
  std::string message;
  try {
    from_toml("shape = \"box\"\nscale = [1, 0, 1]\n");
  } catch (const ConfigError& error) {
    message = error.what();
  }
  CHECK(message ==
        "crown.toml:2: scale: 0 is out of range (three numbers [x, y, z], each more than 0 to 1000)");
}

TEST_CASE("solid: the description reads back from what is written") {
  const Volume volume = from_toml(R"(
shape = "difference"
rotate = [0, 45, 0]
[[parts]]
shape = "box"
size = [1, 2, 3]
scale = [1, 1, 2]
[[parts]]
shape = "revolution"
points = [[0, 0], [1, 2], [0, 4]]
translate = [0, -1, 0]
[[parts]]
shape = "intersection"
[[parts.parts]]
radius = 0.5
)");
  const std::string text = to_toml(Volume::fields(), &volume);
  const Volume again = from_toml(text);
  CHECK(to_toml(Volume::fields(), &again) == text);
  CHECK(again.parts.at(0).size == Vec3(1, 2, 3));
  CHECK(again.parts.at(0).scale == Vec3(1, 1, 2));
  CHECK(again.parts.at(1).points == Sketch{{0, 0}, {1, 2}, {0, 4}});
  CHECK(again.parts.at(2).parts.at(0).radius == 0.5);
  CHECK(text.find("points = [[0, 0], [1, 2], [0, 4]]\n") != std::string::npos);
}
