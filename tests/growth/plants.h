// Small plants made by hand.
#pragma once

#include "growth/plant.h"

namespace ramify::test {

inline growth::Plant seedling(growth::Site site = 0) {
  return growth::seedling({}, site);
}

/// Adds a node above `parent`; where `axis` is not the parent's, it founds it.
inline std::uint32_t add_node(growth::Plant& plant, std::uint32_t parent, std::uint32_t axis,
                              const Vec3& position = {}) {
  plant.position.push_back(position);
  plant.parent.push_back(parent);
  plant.axis.push_back(axis);
  plant.founds_axis.push_back(axis != plant.axis[parent]);
  plant.birth_step.push_back(1);
  plant.lost_tips.push_back(0);
  const auto node = static_cast<std::uint32_t>(plant.node_count() - 1);
  if (axis == plant.axes.size()) {
    plant.axes.push_back({.first = node, .id = plant.axes_founded++, .order = 1});
  }
  ++plant.axes[axis].node_count;
  return node;
}

inline void add_bud(growth::Plant& plant, const growth::Bud& bud, const Vec3f& direction = Vec3f(kUp)) {
  plant.buds.push_back(bud);
  plant.bud_direction.push_back(direction);
}

}  // namespace ramify::test
