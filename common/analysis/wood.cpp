#include <cmath>
#include <numbers>

#include "common/analysis/measures.h"

namespace ramify {

Cone cone_of(const Anatomy& wood, std::size_t node) {
  const Skeleton& s = wood.skeleton();
  const double a = s.start_radius(node);
  const double b = 0.5 * s.diameter[node];
  const double length = s.length(node);
  const double squares = a * a + a * b + b * b;
  Cone cone;
  cone.volume = std::numbers::pi / 3.0 * length * squares;
  cone.surface = std::numbers::pi * (a + b) * std::hypot(length, a - b);
  const double center = squares > 0.0 ? 0.25 * (a * a + 2.0 * a * b + 3.0 * b * b) / squares : 0.5;
  cone.center = s.position[s.parent[node]] + center * s.along(node);
  return cone;
}

void measure_wood(const Anatomy& wood, Metrics& metrics) {
  const Skeleton& s = wood.skeleton();
  metrics.nodes = s.node_count();
  metrics.internodes = s.internode_count();
  metrics.axes = wood.axis_count();
  Vec3 moment(0.0);  // of each cone about the root it stands on
  for (std::size_t node = s.root_count(); node < s.node_count(); ++node) {
    const Cone cone = cone_of(wood, node);
    metrics.total_length += s.length(node);
    metrics.wood_volume += cone.volume;
    metrics.surface_area += cone.surface;
    moment += cone.volume * (cone.center - s.position[wood.root_of()[node]]);
  }
  if (metrics.internodes > 0) {
    metrics.internode_length_mean = metrics.total_length / static_cast<double>(metrics.internodes);
  }
  // The tree's height is measured before.
  if (metrics.wood_volume > 0.0 && metrics.height.value_or(0.0) > 0.0) {
    metrics.lean = std::hypot(moment.x, moment.z) / metrics.wood_volume / *metrics.height;
  }
}

}  // namespace ramify
