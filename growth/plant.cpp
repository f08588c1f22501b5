#include "growth/plant.h"

#include "common/base/rng.h"

namespace ramify::growth {
namespace {

// Which values stay is hard to foretell, so the loops below do not branch on it.

template <class T>
void close_holes(std::vector<T>& values, const std::vector<std::uint32_t>& new_index) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[kept] = values[i];
    kept += new_index[i] != kNone;
  }
  values.resize(kept);
}

/// The places 0 .. count - 1 numbered anew, without those for which `is_hole`.
template <class IsHole>
std::vector<std::uint32_t> numbered(std::size_t count, const IsHole& is_hole) {
  std::vector<std::uint32_t> new_index(count);
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool stays = !is_hole(i);
    new_index[i] = stays ? kept : kNone;
    kept += stays;
  }
  return new_index;
}

void close_nodes(Plant& plant) {
  // An axis is gone with its first node.
  const auto new_axis =
      numbered(plant.axes.size(), [&](std::size_t i) { return plant.is_cut(plant.axes[i].first); });
  const auto new_node = numbered(plant.node_count(), [&](std::size_t node) { return plant.is_cut(node); });
  close_holes(plant.axes, new_axis);
  for (Axis& axis : plant.axes) axis.first = new_node[axis.first];
  close_holes(plant.position, new_node);
  close_holes(plant.parent, new_node);
  close_holes(plant.axis, new_node);
  close_holes(plant.founds_axis, new_node);
  close_holes(plant.birth_step, new_node);
  close_holes(plant.lost_tips, new_node);
  close_holes(plant.id, new_node);
  for (std::uint32_t& axis : plant.axis) axis = new_axis[axis];
  for (std::size_t node = 1; node < plant.node_count(); ++node) {
    plant.parent[node] = new_node[plant.parent[node]];
  }
  for (Bud& bud : plant.buds) {
    if (bud.is_dead()) continue;
    bud.node = new_node[bud.node];
  }
  plant.cut_nodes = 0;
}

}  // namespace

Plant seedling(const TreePlace& place, Site site) {
  Plant plant;
  plant.position.push_back(place.position);
  plant.parent.push_back(kNone);
  plant.axis.push_back(0);
  plant.founds_axis.push_back(0);
  plant.birth_step.push_back(0);
  plant.lost_tips.push_back(0);

  Axis trunk;
  trunk.node_count = 1;
  const double azimuth = Rng::stream(place.seed, Stream::axis, 0).uniform(0.0, 2.0 * std::numbers::pi);
  trunk.reference = Vec3f(perpendicular_at(kUp, azimuth));
  plant.axes.push_back(trunk);
  plant.axes_founded = 1;
  plant.buds.push_back({.node = 0, .site = site, .direction = Vec3f(kUp), .is_terminal = true});
  return plant;
}

void compact(Plant& plant, double share) {
  const auto has_many = [share](std::uint32_t holes, std::size_t size) {
    return holes > 0 && double(holes) >= share * double(size);
  };
  if (has_many(plant.cut_nodes, plant.node_count())) close_nodes(plant);
  if (has_many(plant.dead_buds, plant.buds.size())) {
    std::erase_if(plant.buds, [](const Bud& bud) { return bud.is_dead(); });
    plant.dead_buds = 0;
  }
}

}  // namespace ramify::growth
