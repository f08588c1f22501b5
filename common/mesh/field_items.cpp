#include "common/mesh/field_items.h"

#include <algorithm>

namespace ramify {

Box FieldItems::bounds(std::uint32_t item) const {
  if (is_cone(item)) return cone(item).bounds;
  Box box;
  box.include(fork(item).center - fork(item).zone);
  box.include(fork(item).center + fork(item).zone);
  return box;
}

bool FieldItems::can_matter(std::uint32_t item, const Vec3& center, double radius) const {
  if (is_cone(item)) return cone(item).distance(center) <= radius;
  const ForkBlend& one = fork(item);
  if (glm::length(center - one.center) > one.zone + radius) return false;
  const auto nearest = [&](const std::vector<std::uint32_t>& cones) {
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t index : cones) least = std::min(least, cone(index).distance(center));
    return least;
  };
  // Distances change no faster than places do.
  const double a = nearest(one.cones);
  const double b = nearest(one.others);
  return std::abs(a - b) < one.width + 2.0 * radius && std::min(a, b) <= radius + kBlendDepth * one.width;
}

double FieldItems::union_distance(std::span<const std::uint32_t> items, const Vec3& point) const {
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t item : items) {
    if (is_cone(item)) least = std::min(least, cone(item).distance(point));
  }
  return least;
}

}  // namespace ramify
