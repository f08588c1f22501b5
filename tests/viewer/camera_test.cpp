#include "viewer/camera.h"

#include "tests/catch.h"
#include "tests/viewer/close.h"

using namespace ramify;
using namespace ramify::test;

namespace {

/// Where the camera puts a world point in the picture, from -1 to 1 across and up.
glm::dvec2 place(const Camera& camera, const Vec3& point) {
  const glm::dvec4 clip = camera.world_to_clip() * glm::dvec4(point, 1.0);
  return glm::dvec2(clip) / clip.w;
}

bool is_near(const Vec3& a, const Vec3& b) {
  return glm::length(a - b) < 1e-12;
}

}  // namespace

TEST_CASE("view: names stand for directions") {
  const auto front = parse_view("front");
  REQUIRE(front);
  CHECK(front->azimuth_deg == 0.0);
  CHECK(front->elevation_deg == 0.0);
  CHECK_FALSE(front->is_parallel);
  CHECK(parse_view("side")->azimuth_deg == 90.0);
  CHECK(parse_view("top")->elevation_deg == 90.0);
}

TEST_CASE("view: two numbers are azimuth and elevation in degrees") {
  const auto view = parse_view("-30.5,12");
  REQUIRE(view);
  CHECK(view->azimuth_deg == -30.5);
  CHECK(view->elevation_deg == 12.0);
  CHECK(parse_view("400,-90")->azimuth_deg == 400.0);
}

TEST_CASE("view: what is malformed, not finite or beyond the poles is refused") {
  for (const char* text : {"", "back", "Front", "30", "30,", ",10", "30,10,5", "30, 10", "x,1", "1,2m",
                           "0,90.1", "0,-91", "nan,0", "0,nan", "inf,0", "1e999,0"}) {
    INFO(text);
    CHECK_FALSE(parse_view(text));
  }
}

TEST_CASE("camera: front looks from +Z, side from +X and top straight down") {
  CHECK(is_near(camera_axes(0, 0).back, {0, 0, 1}));
  CHECK(is_near(camera_axes(0, 0).right, {1, 0, 0}));
  CHECK(is_near(camera_axes(90, 0).back, {1, 0, 0}));
  CHECK(is_near(camera_axes(90, 0).right, {0, 0, -1}));
  CHECK(is_near(camera_axes(0, 90).back, {0, 1, 0}));
  CHECK(is_near(camera_axes(0, 90).up, {0, 0, -1}));
}

TEST_CASE("camera: its axes are orthonormal and right-handed") {
  for (double azimuth : {-170.0, -40.0, 0.0, 33.0, 200.0}) {
    for (double elevation : {-90.0, -30.0, 0.0, 60.0, 90.0}) {
      const CameraAxes axes = camera_axes(azimuth, elevation);
      CHECK(is_close(glm::length(axes.back), 1.0));
      CHECK(is_close(glm::length(axes.right), 1.0));
      CHECK(is_near(glm::cross(axes.right, axes.up), axes.back));
      CHECK(is_near(axes.world(axes.coordinates({1, 2, 3})), {1, 2, 3}));
    }
  }
}

TEST_CASE("framing: every point is inside the margins, and one touches them, in any view and shape") {
  const Vec3 points[] = {{0, 0, 0}, {0.3, 12, -0.2}, {4, 7, 1}, {-3, 9, -2}, {-1, 5, 3.5}};
  for (bool is_parallel : {false, true}) {
    for (double azimuth : {0.0, 77.0}) {
      for (double elevation : {-40.0, 0.0, 25.0, 90.0}) {
        for (double aspect : {0.1, 0.7, 1.0, 3.0}) {
          Framer framer({azimuth, elevation, is_parallel}, aspect, 0.05);
          for (const Vec3& point : points) framer.include(point);
          const Camera camera = framer.camera(10.0);
          double farthest = 0.0;
          for (const Vec3& point : points) {
            const glm::dvec2 at = glm::abs(place(camera, point));
            farthest = std::max({farthest, at.x, at.y});
          }
          CHECK(is_close(farthest, 0.9, 1e-6));
        }
      }
    }
  }
}

TEST_CASE("framing: a single point, or none, gives a camera that looks at it") {
  for (bool is_parallel : {false, true}) {
    Framer framer({30.0, 20.0, is_parallel}, 1.5, 0.05);
    CHECK(glm::length(place(framer.camera(1.0), Vec3(0.0))) < 1e-9);
    framer.include({5, 6, 7});
    CHECK(glm::length(place(framer.camera(1.0), {5, 6, 7})) < 1e-9);
  }
}

TEST_CASE("close-up: a point is three numbers") {
  CHECK(is_near(parse_point("1,-2.5,3e-1").value(), {1.0, -2.5, 0.3}));
  for (const char* text : {"", "1,2", "1,2,3,4", "1,2,", "a,2,3", "1,2,inf", "1, 2,3"}) {
    INFO(text);
    CHECK_FALSE(parse_point(text));
  }
}

TEST_CASE("close-up: the place is in the middle and its shorter side as wide as asked for") {
  const CloseUp place{{1.0, 2.0, -3.0}, 0.4};
  for (const bool is_parallel : {false, true}) {
    for (const double aspect : {1.0, 2.0, 0.5}) {
      const Camera camera = close_up_camera({30.0, 20.0, is_parallel}, aspect, place, -50.0);
      CHECK(glm::length(::place(camera, place.center)) < 1e-9);
      const glm::dvec2 edge =
          ::place(camera, place.center + camera.axes.right * (0.2 * std::max(aspect, 1.0)) +
                              camera.axes.up * (0.2 / std::min(aspect, 1.0)));
      CHECK(glm::length(edge - glm::dvec2(1.0)) < 1e-9);
      const glm::dvec4 behind = camera.world_to_clip() * glm::dvec4(camera.axes.back * -49.9, 1.0);
      CHECK(behind.z / behind.w < 1.0);
    }
  }
}
