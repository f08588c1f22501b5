// Where a graph lies in the world. Graphs of one level are made alike, each in a frame of its own.
#pragma once

#include "common/base/geometry.h"

namespace ramify::pathplan {

/// A graph's own axes: of level 1 the world's; of a later one the origin is its root and +Y its v_g.
struct Frame {
  Vec3 origin{0.0};
  glm::dmat3 axes{1.0};  // columns, unit and perpendicular

  Vec3 to_world(const Vec3& point) const { return origin + axes * point; }
};

/// `along` is a unit vector.
inline Frame frame_along(const Vec3& origin, const Vec3& along) {
  const Vec3 side = any_perpendicular(along);
  return {origin, glm::dmat3(side, along, glm::cross(side, along))};
}

}  // namespace ramify::pathplan
