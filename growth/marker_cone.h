// The cone in which a bud sees markers. Coordinates from the low corner of their grid's box, metres.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "growth/marker_grid.h"

namespace ramify::growth {

/// Rises with `value` and compares cosines without a square root: a >= c * |v| as the signed squares of both
/// sides.
template <class Real>
Real signed_square(Real value) {
  return value * std::abs(value);
}

/// What all cones that are as long and wide have in common.
struct ConeShape {
  // The edge of the cone belongs to it, whatever the rounding of cosines.
  static constexpr double kSlack = 1e-9;

  ConeShape() = default;
  ConeShape(double length, double least_cosine)
      : radius(length), min_cosine(least_cosine), cosine_square(signed_square(least_cosine - kSlack)) {
    const double exact = std::clamp(least_cosine - kSlack, -1.0, 1.0);
    cosine = static_cast<float>(exact);
    sine = static_cast<float>(std::sqrt(1.0 - exact * exact));
    // Up to a right angle the ball touches apex and rim; then the rim is its widest circle; then it is all.
    constexpr double wide_cosine = 0.5 * std::numbers::sqrt2;
    const double distance = length * (exact >= wide_cosine ? 0.5 / exact : std::max(0.0, exact));
    ball_distance = static_cast<float>(distance);
    ball_radius = static_cast<float>(
        exact >= wide_cosine ? distance : length * (exact > 0.0 ? std::sqrt(1.0 - exact * exact) : 1.0));
  }

  bool is_of(double length, double least_cosine) const {
    return radius == length && min_cosine == least_cosine;
  }

  double radius = -1.0;        // none
  double min_cosine = 0.0;     // of the half angle
  double cosine_square = 0.0;  // signed
  float cosine = 0.0F;
  float sine = 0.0F;
  float ball_distance = 0.0F;  // a ball that holds the cone: its centre, from the apex along the direction
  float ball_radius = 0.0F;
};

struct Cone {
  bool contains(const Vec3& to_marker, double square) const {
    return (square <= shape.radius * shape.radius) &
           (signed_square(glm::dot(direction, to_marker)) >= shape.cosine_square * square);
  }

  /// A lens that holds it: the ball about it, the one about its apex and the box about it.
  Lens lens() const {
    const auto reach = static_cast<float>(shape.radius);
    const Lanes from = lanes_of(apex);
    const Lanes along = lanes_of(direction);
    const Lanes across = shape.sine * square_root(greater(1.0F - along * along, Lanes{}));
    // Along an axis that is nearly the direction the root makes much of what floats round off.
    const float slack = 1e-3F * reach;
    const Lanes most = greater(shape.cosine * along + across, Lanes{});
    const Lanes least = lesser(shape.cosine * along - across, Lanes{});
    const Lanes high = reach * (along >= shape.cosine ? all_lanes(1.0F) : most) + slack;
    const Lanes low = reach * (along <= -shape.cosine ? all_lanes(-1.0F) : least) - slack;
    return {from + shape.ball_distance * along, shape.ball_radius, from, reach, from + low, from + high};
  }

  const ConeShape& shape;
  Vec3 apex;
  Vec3 direction;  // unit
};

/// What is known of four markers at a glance.
struct Glance {
  Lanes square;      // of the distance; nearer than it is by no more than what floats round off
  LaneMask is_seen;  // true for a few more than are
};

/// The same for four markers at a time, wider by what floats round off.
struct ConeView {
  explicit ConeView(const Cone& cone) : apex(cone.apex), direction(cone.direction) {
    // Floats hold offsets to 2^-24 of their size, three of them a vector.
    const Vec3 far = glm::abs(cone.apex) + cone.shape.radius;
    const double slack = 0x1p-21 * std::max({far.x, far.y, far.z});
    const double wide_radius = cone.shape.radius + slack;
    square_radius = static_cast<float>(wide_radius * wide_radius * (1.0 + 1e-5));
    margin = static_cast<float>(wide_radius * wide_radius - cone.shape.radius * cone.shape.radius) +
             1e-5F * square_radius;
    lead = static_cast<float>(2.0 * slack);
    cosine_square = static_cast<float>(cone.shape.cosine_square - 1e-5);
  }

  Glance look(const float* x, const float* y, const float* z) const {
    const Lanes dx = load_lanes(x) - apex.x;
    const Lanes dy = load_lanes(y) - apex.y;
    const Lanes dz = load_lanes(z) - apex.z;
    const Lanes square = dx * dx + dy * dy + dz * dz;
    const Lanes along = dx * direction.x + dy * direction.y + dz * direction.z + lead;
    return {square - margin,
            (square <= square_radius) & (along * magnitude(along) >= cosine_square * square)};
  }

  Vec3f apex;
  Vec3f direction;
  float square_radius;
  float margin;  // the most that a square within the reach is off
  float lead;    // added to what is along the direction
  float cosine_square;
};

}  // namespace ramify::growth
