#include "common/volume/placement.h"

#include <algorithm>

#include "common/volume/volume.h"

namespace ramify {
namespace {

/// Turned about x, then y, then z; degrees.
glm::dmat3 rotation(const Vec3& degrees) {
  glm::dmat3 turned(1.0);
  for (int column = 0; column < 3; ++column) {
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 about = glm::dmat3(1.0)[axis];
      turned[column] = rotated(turned[column], about, radians(degrees[axis]));
    }
  }
  return turned;
}

}  // namespace

Placement::Placement(const Placement& around, const Volume& volume) : Placement(around) {
  const bool is_moved = volume.translate != Vec3(0.0);
  const bool is_turned = volume.rotate != Vec3(0.0);
  const bool is_scaled = volume.scale != Vec3(1.0);
  if (!is_moved && !is_turned && !is_scaled) return;

  const Vec3& scale = volume.scale;
  offset_ = around.to_world(volume.translate);
  if (is_turned) linear_ = linear_ * rotation(volume.rotate);
  for (int column = 0; column < 3; ++column) linear_[column] *= scale[column];
  inverse_ = glm::inverse(linear_);
  least_scale_ *= std::min({scale.x, scale.y, scale.z});
  is_identity_ = false;
  is_even_ = is_even_ && scale.x == scale.y && scale.y == scale.z;
  is_upright_ = is_upright_ && !is_turned;
}

}  // namespace ramify
