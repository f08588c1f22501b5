// A film's camera: what it shows stays where it is from frame to frame.

#include "viewer/film_camera.h"

#include "tests/catch.h"
#include "tests/viewer/poles.h"
#include "viewer/camera.h"

using namespace ramify;
using namespace ramify::test;

namespace {

Camera camera_on(const std::vector<Vec3f>& room, double azimuth_deg, bool is_parallel) {
  Framer framer({.azimuth_deg = azimuth_deg, .elevation_deg = 20.0, .is_parallel = is_parallel}, 1.5, 0.05);
  for (const Vec3f& point : room) framer.include(Vec3(point));
  return framer.camera(1.0);
}

}  // namespace

TEST_CASE("film: there is room for the finished tree and for branches that were shed") {
  const Skeleton pole = pole_of(2, 4.0, 0.4);
  const Mesh mesh = tube_mesh(pole);
  const Scene scene{&mesh, &pole};
  std::vector<Vec3> whole = pole.position;
  whole.emplace_back(3.0, 2.0, 0.0);
  Box lit;
  for (const Vec3f& point : film_room(scene, whole, RenderStyle::lit)) lit.include(Vec3(point));
  CHECK(lit.high.x == 3.0);
  CHECK(lit.low.x == Approx(-0.2).margin(1e-6));
  CHECK(lit.high.y == 4.0);
  // Lines have no thickness.
  Box lines;
  for (const Vec3f& point : film_room(scene, whole, RenderStyle::skeleton)) lines.include(Vec3(point));
  CHECK(lines.low.x == 0.0);
}

TEST_CASE("film: swept room holds the points it was made of, from any side") {
  const std::vector<Vec3f> room = {{0, 0, 0}, {2, 1, 0.5f}, {-1, 3, -1}, {0.5f, 4, 0}};
  const std::vector<Vec3f> swept = swept_room(room);
  for (const double azimuth : {0.0, 33.3, 90.0, 181.0}) {
    Framer points({.azimuth_deg = azimuth, .is_parallel = true}, 1.0, 0.0);
    Framer around({.azimuth_deg = azimuth, .is_parallel = true}, 1.0, 0.0);
    for (const Vec3f& point : room) points.include(Vec3(point));
    for (const Vec3f& point : swept) around.include(Vec3(point));
    CHECK(around.extent().low.x <= points.extent().low.x + 1e-3);
    CHECK(around.extent().high.x >= points.extent().high.x - 1e-3);
    CHECK(around.extent().low.y == Approx(0.0).margin(1e-6));
    CHECK(around.extent().high.y == Approx(4.0));
  }
  CHECK(swept_room({}).empty());
}

TEST_CASE("film: about swept room the camera turns without coming nearer") {
  const std::vector<Vec3f> swept =
      swept_room(std::vector<Vec3f>{{-1, 0, 0}, {2, 1, 0.5f}, {-1, 3, -1}, {0.5f, 4, 0}});
  for (const bool is_parallel : {false, true}) {
    const Camera first = camera_on(swept, 0.0, is_parallel);
    const Vec3 middle(0.5, 0.0, -0.25);
    const double distance = glm::length(first.eye - middle);
    for (const double azimuth : {1.0, 17.3, 45.5, 120.0, 270.0}) {
      const Camera turned = camera_on(swept, azimuth, is_parallel);
      CHECK(glm::length(turned.eye - middle) == Approx(distance).epsilon(1e-4));
      CHECK(turned.eye.y == Approx(first.eye.y).epsilon(1e-4));
      CHECK(turned.half_size.x == Approx(first.half_size.x).epsilon(1e-4));
    }
  }
}
