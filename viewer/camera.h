// Where a picture is taken from. Pure geometry, no OpenGL.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "common/base/geometry.h"

namespace ramify {

/// From where the tree is looked at. Azimuth 0 looks from +Z towards -Z, 90 from +X; elevation 90 straight
/// down.
struct ViewDirection {
  double azimuth_deg = 0.0;
  double elevation_deg = 0.0;
  bool is_parallel = false;  // no perspective; the styles schematic and skeleton never have any
};

/// "front", "side", "top" or "AZ,EL" in degrees; nullopt if malformed, not finite or EL outside -90 .. 90.
std::optional<ViewDirection> parse_view(std::string_view text);

/// Orthonormal and right-handed; `back` points from the scene to the viewer. `right` is level.
struct CameraAxes {
  Vec3 right;
  Vec3 up;
  Vec3 back;

  /// Coordinates of a world vector along right, up and back.
  Vec3 coordinates(const Vec3& v) const { return {glm::dot(v, right), glm::dot(v, up), glm::dot(v, back)}; }
  Vec3 world(const Vec3& coordinates) const {
    return right * coordinates.x + up * coordinates.y + back * coordinates.z;
  }
};

CameraAxes camera_axes(double azimuth_deg, double elevation_deg);

struct Camera {
  CameraAxes axes;
  Vec3 eye{0.0};
  bool is_parallel = false;
  glm::dvec2 half_size{1.0};  // of the picture: metres if parallel, else tangents of half the field of view
  double near_distance = 0.1;
  double far_distance = 100.0;

  /// World to OpenGL's clip space.
  glm::dmat4 world_to_clip() const;
};

std::array<Vec3, 8> corners(const Box& box);

/// A place of the scene that fills the picture.
struct CloseUp {
  Vec3 center{0.0};
  double across = 1.0;  // metres that the picture's shorter side shows there
};

/// "X,Y,Z" in metres; nullopt if malformed or not finite.
std::optional<Vec3> parse_point(std::string_view text);

/// The camera that has the place in the middle. It sees as far as the depth `farthest`, a coordinate along
/// the view's axis `back`; what lies just before the viewer is cut away.
Camera close_up_camera(const ViewDirection& view, double aspect, const CloseUp& place, double farthest);

/// Tangent of half the angle that cameras with perspective see along the picture's longer side.
double field_of_view();

/// Finds the camera that has all the points it was shown in the picture, as large as they fit. Only their
/// extremes are kept.
class Framer {
 public:
  /// `aspect` is the picture's width over its height; `margin` is left free at each edge, in parts of the
  /// picture.
  Framer(const ViewDirection& view, double aspect, double margin);

  /// With half the size of the whole picture given, as in Camera; in proportion if parallel.
  Framer(const ViewDirection& view, const glm::dvec2& half_size, double margin);

  void include(const Vec3& point);

  /// Of what was included, in coordinates along the camera's axes.
  const Box& extent() const { return extent_; }
  const CameraAxes& axes() const { return axes_; }

  /// `reach` beyond the points, metres, is kept between the near and far planes: for the ground. Without any
  /// point the camera looks at the origin.
  Camera camera(double reach) const;

 private:
  CameraAxes axes_;
  bool is_parallel_ = false;
  glm::dvec2 half_size_;  // of the whole picture: tangents, or in proportion
  glm::dvec2 free_size_;  // of the part within the margins
  Box extent_;
  // For each of right and up: the extremes of coordinate +- tangent * depth, which bound the frustum's sides.
  glm::dvec2 high_side_;
  glm::dvec2 low_side_;
};

}  // namespace ramify
