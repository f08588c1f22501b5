#include "viewer/orbit.h"

#include <algorithm>

namespace ramify {
namespace {

constexpr double kMargin = 0.06;  // free at each edge of a framed picture, in parts of it
constexpr double kZoomStep = 1.2;
constexpr double kNearest = 0.01;  // metres
constexpr double kFarthest = 1e4;

// The near plane comes no nearer than this part of the distance: the depth buffer's floats reach that far.
constexpr double kNearShare = 0.01;

/// Half of what is seen across and up, as tangents. Other than a picture's framing it depends on the height
/// alone: a pane that is made wider shows more beside the tree and not less of it.
glm::dvec2 half_view(double aspect) {
  return field_of_view() * glm::dvec2(aspect, 1.0);
}

double clamped_distance(double distance) {
  return std::clamp(distance, kNearest, kFarthest);
}

}  // namespace

Orbit turned(Orbit orbit, const glm::dvec2& drag, double height) {
  const double degrees_a_pixel = 180.0 / std::max(height, 1.0);
  orbit.azimuth_deg = std::remainder(orbit.azimuth_deg - drag.x * degrees_a_pixel, 360.0);
  orbit.elevation_deg = std::clamp(orbit.elevation_deg + drag.y * degrees_a_pixel, -90.0, 90.0);
  return orbit;
}

Orbit panned(Orbit orbit, const glm::dvec2& drag, const glm::dvec2& size) {
  const CameraAxes axes = camera_axes(orbit.azimuth_deg, orbit.elevation_deg);
  const double height = std::max(size.y, 1.0);
  const double metres_a_pixel = 2.0 * orbit.distance * field_of_view() / height;
  orbit.target += (axes.up * drag.y - axes.right * drag.x) * metres_a_pixel;
  return orbit;
}

Orbit zoomed(Orbit orbit, double steps) {
  orbit.distance = clamped_distance(orbit.distance * std::pow(kZoomStep, -steps));
  return orbit;
}

Orbit framed(Orbit orbit, std::span<const Vec3> points, double aspect) {
  if (points.empty()) return orbit;
  Framer framer({orbit.azimuth_deg, orbit.elevation_deg, orbit.is_parallel}, half_view(aspect), kMargin);
  Box box;
  for (const Vec3& point : points) {
    framer.include(point);
    box.include(point);
  }
  const Camera camera = framer.camera(0.0);
  const Vec3 eye = framer.axes().coordinates(camera.eye);
  const double depth = framer.axes().coordinates(box.center()).z;
  orbit.target = framer.axes().world({eye.x, eye.y, depth});
  orbit.distance = clamped_distance(orbit.is_parallel ? camera.half_size.y / field_of_view() : eye.z - depth);
  return orbit;
}

Camera camera_of(const Orbit& orbit, double aspect, const Box& box, double reach) {
  Camera camera;
  camera.axes = camera_axes(orbit.azimuth_deg, orbit.elevation_deg);
  camera.is_parallel = orbit.is_parallel;
  camera.half_size = half_view(aspect) * (orbit.is_parallel ? orbit.distance : 1.0);

  Box shown = box;
  shown.include(orbit.target);
  double nearest = std::numeric_limits<double>::infinity();  // towards the viewer, from the target
  double farthest = 0.0;
  for (const Vec3& corner : corners(shown)) {
    const double towards = camera.axes.coordinates(corner - orbit.target).z;
    nearest = std::min(nearest, orbit.distance - towards);
    farthest = std::max(farthest, orbit.distance - towards);
  }
  nearest -= reach;
  farthest += reach;
  // Without perspective nothing is behind the eye: it stands back from all there is.
  const double back = orbit.is_parallel ? std::max(0.0, kNearest - nearest) : 0.0;
  camera.eye = orbit.target + camera.axes.back * (orbit.distance + back);
  camera.near_distance = std::max(nearest + back, kNearShare * orbit.distance);
  if (orbit.is_parallel) camera.near_distance = nearest + back;
  camera.far_distance = std::max(farthest + back, 2.0 * camera.near_distance);
  return camera;
}

}  // namespace ramify
