// Where the nodes and edges of one graph may be.
#pragma once

#include "common/base/geometry.h"
#include "common/volume/solid.h"
#include "pathplan/frame.h"
#include "pathplan/surroundings.h"

namespace ramify::pathplan {

/// A solid in the graph's own frame, without the obstacles, which are in the world. Looks at all three.
struct Domain {
  const Solid& solid;
  const Surroundings& surroundings;
  Frame frame = {};

  bool contains(const Vec3& point) const {
    return solid.contains(point) &&
           (!surroundings.has_obstacles() || surroundings.is_free(frame.to_world(point)));
  }

  /// Whether no obstacle is between two points.
  bool is_free(const Vec3& from, const Vec3& to) const {
    return !surroundings.has_obstacles() || surroundings.is_free(frame.to_world(from), frame.to_world(to));
  }

  double cost_factor(const Vec3& middle) const {
    return surroundings.has_costs() ? surroundings.cost_factor(frame.to_world(middle)) : 1.0;
  }
};

}  // namespace ramify::pathplan
