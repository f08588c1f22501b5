#include "pathplan/subgraph_volume.h"

#include <cmath>

namespace ramify::pathplan {

double subgraph_radius(const Level& row, std::size_t level) {
  return row.r * std::pow(row.a, static_cast<double>(level) - 2.0);
}

Volume subgraph_volume(const Level& row, double radius) {
  const double half_width = radius * std::tan(radians(row.alpha_deg));
  switch (row.subgraph) {
    case SubgraphShape::sphere_portion:
      return {.shape = Shape::sphere_portion, .radius = radius, .angle_deg = row.alpha_deg};
    case SubgraphShape::cone:
      return {.shape = Shape::cone, .radius = half_width, .height = radius};
    case SubgraphShape::inverted_cone:
      return {.shape = Shape::cone,
              .center = {0.0, radius, 0.0},
              .radius = half_width,
              .height = radius,
              .direction = -kUp};
    case SubgraphShape::ellipsoid:
      return {.shape = Shape::ellipsoid,
              .center = {0.0, radius / 2.0, 0.0},
              .radii = {half_width / 2.0, radius / 2.0, half_width / 2.0}};
    case SubgraphShape::custom:
      return {.shape = Shape::union_of, .scale = Vec3(radius), .parts = {row.volume}};
  }
  return {};
}

}  // namespace ramify::pathplan
