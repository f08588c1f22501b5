#include "viewer/orbit.h"

#include <algorithm>
#include <cmath>

#include "tests/catch.h"
#include "tests/viewer/close.h"
#include "viewer/scene.h"

using namespace ramify;
using ramify::test::is_close;

namespace {

/// Where a point comes out in a picture that runs from -1 to 1, and its depth.
Vec3 in_picture(const Camera& camera, const Vec3& point) {
  const glm::dvec4 clip = camera.world_to_clip() * glm::dvec4(point, 1.0);
  return Vec3(clip) / clip.w;
}

Box some_box() {
  Box box;
  box.include({-1.0, 0.0, -2.0});
  box.include({3.0, 9.0, 1.0});
  return box;
}

}  // namespace

TEST_CASE("orbit: a drag over the picture's height turns half way round and stops at the poles") {
  const Orbit start;
  CHECK(is_close(turned(start, {-300.0, 0.0}, 600.0).azimuth_deg, 90.0));
  CHECK(is_close(turned(start, {0.0, 150.0}, 600.0).elevation_deg, 45.0));
  CHECK(turned(start, {0.0, 6000.0}, 600.0).elevation_deg == 90.0);
  CHECK(turned(start, {0.0, -6000.0}, 600.0).elevation_deg == -90.0);
}

TEST_CASE("orbit: what is at the target stays under the pointer when the view is panned") {
  for (bool is_parallel : {false, true}) {
    Orbit orbit{.target = {1.0, 2.0, 3.0}, .azimuth_deg = 30.0, .elevation_deg = 20.0, .distance = 7.0};
    orbit.is_parallel = is_parallel;
    const glm::dvec2 size(800.0, 500.0);
    const glm::dvec2 drag(160.0, 50.0);
    const Orbit moved = panned(orbit, drag, size);
    const Vec3 at = in_picture(camera_of(moved, size.x / size.y, some_box(), 1.0), orbit.target);
    CHECK(is_close(at.x, 2.0 * drag.x / size.x));
    CHECK(is_close(at.y, -2.0 * drag.y / size.y));
  }
}

TEST_CASE("orbit: zooming there and back changes nothing, and ends at a centimetre") {
  const Orbit start{.distance = 3.0};
  CHECK(is_close(zoomed(zoomed(start, 2.0), -2.0).distance, 3.0));
  CHECK(zoomed(start, 1.0).distance < 3.0);
  CHECK(zoomed(start, 1e3).distance == 0.01);
  CHECK(zoomed(start, -1e3).distance == 1e4);
}

TEST_CASE("orbit: a framed box fills the picture without leaving it, and lies between near and far") {
  const Box box = some_box();
  for (bool is_parallel : {false, true}) {
    for (double aspect : {0.5, 1.0, 1.8}) {
      for (double elevation : {-90.0, -20.0, 0.0, 35.0, 90.0}) {
        INFO("parallel " << is_parallel << ", aspect " << aspect << ", elevation " << elevation);
        Orbit orbit{.azimuth_deg = 40.0, .elevation_deg = elevation, .is_parallel = is_parallel};
        orbit = framed(orbit, corners(box), aspect);
        const Camera camera = camera_of(orbit, aspect, box, 0.0);
        double widest = 0.0;
        for (const Vec3& corner : corners(box)) {
          const Vec3 at = in_picture(camera, corner);
          CHECK(std::abs(at.z) <= 1.0 + 1e-9);
          widest = std::max({widest, std::abs(at.x), std::abs(at.y)});
        }
        CHECK(is_close(widest, 0.88));
      }
    }
  }
}

TEST_CASE("orbit: from within the tree the near plane stays before the eye") {
  const Orbit orbit{.target = {1.0, 4.0, 0.0}, .distance = 0.5};
  const Camera camera = camera_of(orbit, 1.0, some_box(), 20.0);
  CHECK(is_close(camera.near_distance, 0.005));
  CHECK(camera.far_distance > 20.0);
}

TEST_CASE("outline: few points of very many take up as much room as all of them, from any side") {
  std::vector<Vec3f> points;
  for (int i = 0; i < 400'000; ++i) {  // a ball with a longer side, filled by a golden spiral
    const double height = 1.0 - 2.0 * (i + 0.5) / 400'000;
    const double round = std::sqrt(1.0 - height * height);
    const double angle = 2.399963 * i;
    const double radius = std::cbrt(static_cast<double>(i * 7919LL % 400'000) / 400'000.0);
    points.emplace_back(radius *
                        Vec3(3.0 * round * std::cos(angle), 5.0 * height, 3.0 * round * std::sin(angle)));
  }
  const std::vector<Vec3f> outline = outline_of(points);
  CHECK(outline.size() < points.size() / 4);
  const auto reach = [](const std::vector<Vec3f>& of, const Vec3f& towards) {
    float most = -1e9f;
    for (const Vec3f& point : of) most = std::max(most, glm::dot(point, towards));
    return most;
  };
  for (int i = 0; i < 50; ++i) {
    const float height = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / 50.0f;
    const float round = std::sqrt(1.0f - height * height);
    const float angle = 2.399963f * static_cast<float>(i);
    const Vec3f towards(round * std::cos(angle), height, round * std::sin(angle));
    CHECK(reach(outline, towards) > 0.995f * reach(points, towards));
  }
  for (const Vec3f& axis : {Vec3f(1, 0, 0), Vec3f(0, -1, 0), Vec3f(0, 0, 1)}) {
    CHECK(reach(outline, axis) == reach(points, axis));
  }
  points.resize(1000);
  CHECK(outline_of(points) == points);
}
