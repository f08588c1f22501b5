// Which coordinate of a file points up. Ours is Y; most programs that measure trees have Z.
#pragma once

#include "common/base/geometry.h"

namespace ramify {

enum class UpAxis { y, z };

// Turned by a quarter about X, exactly; 0.0 - v makes no negative zero.

/// A point of a file with +Z up in our axes.
inline Vec3 from_z_up(const Vec3& p) {
  return {p.x, p.z, 0.0 - p.y};
}

/// A point of ours in the axes of a file with +Z up.
inline Vec3 z_up(const Vec3& p) {
  return {p.x, 0.0 - p.z, p.y};
}

}  // namespace ramify
