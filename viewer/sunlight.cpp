#include "viewer/sunlight.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace ramify {
namespace {

constexpr double kAzimuthFromView = -52.0;  // degrees; negative is to the left
constexpr double kElevation = 42.0;

}  // namespace

CameraAxes sun_behind(const ViewDirection& view) {
  return camera_axes(view.azimuth_deg + kAzimuthFromView, kElevation);
}

SunView sun_view(const CameraAxes& sun, std::initializer_list<std::span<const Vec3f>> casters,
                 double ground) {
  Box box;
  for (const std::span<const Vec3f> caster : casters) {
    for (const Vec3f& position : caster) {
      const Vec3 at(position);
      box.include(sun.coordinates(at));
      // Where the sun's ray through it meets the ground: the same place in the picture, only deeper.
      box.include(sun.coordinates(at - sun.back * std::max(0.0, (at.y - ground) / sun.back.y)));
    }
  }
  if (box.is_empty()) box.include(Vec3(0.0));

  const double blur = kPenumbra * box.size().z;
  const double room = blur + 1e-3 + 0.01 * std::max(box.size().x, box.size().y);
  box.low -= room;
  box.high += room;
  SunView view;
  view.axes = sun;
  view.size = glm::dvec2(box.size());
  view.depth = box.size().z;
  // Rows of the matrix are the axes; transposed since glm keeps columns.
  const glm::dmat4 to_axes = glm::transpose(glm::dmat4(glm::dvec4(sun.right, 0.0), glm::dvec4(sun.up, 0.0),
                                                       glm::dvec4(sun.back, 0.0), glm::dvec4(0, 0, 0, 1)));
  const glm::dmat4 to_unit = glm::scale(glm::dmat4(1.0), Vec3(1.0, 1.0, -1.0) / box.size()) *
                             glm::translate(glm::dmat4(1.0), Vec3(-box.low.x, -box.low.y, -box.high.z));
  view.world_to_map = to_unit * to_axes;
  return view;
}

}  // namespace ramify
