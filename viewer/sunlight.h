// The sun, and the parallel view from it that shadows are made with.
#pragma once

#include <initializer_list>
#include <span>

#include "common/base/geometry.h"
#include "viewer/camera.h"

namespace ramify {

/// Where the sun stands for a picture: behind the viewer's left shoulder.
CameraAxes sun_behind(const ViewDirection& view);

/// A picture taken from the sun. Depth runs from 0 nearest to the sun to 1.
struct SunView {
  CameraAxes axes;               // back points to the sun
  glm::dmat4 world_to_map{1.0};  // x and y from 0 to 1 over the picture, z from 0 to 1 over its depth
  glm::dvec2 size{1.0};          // metres across and up the picture
  double depth = 1.0;            // metres
};

/// The view that just holds what casts shadows and these shadows on the ground, with room for the blur of
/// their edges.
SunView sun_view(const CameraAxes& sun, std::initializer_list<std::span<const Vec3f>> casters, double ground);

/// Radius of the blur that a metre between the shadow's edge and what casts it brings: the sun's is 0.0047,
/// ours a little more, as through haze.
inline constexpr double kPenumbra = 0.010;

}  // namespace ramify
