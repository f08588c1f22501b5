#include "growth/plant.h"

#include "common/base/rng.h"

namespace ramify::growth {
namespace {

template <class T>
void close_holes(std::vector<T>& values, const std::vector<std::uint32_t>& new_index) {
  if (values.empty()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (new_index[i] != kNone) values[kept++] = values[i];
  }
  values.resize(kept);
}

/// An axis is gone with its first node.
std::vector<std::uint32_t> numbered_axes(const Plant& plant) {
  std::vector<std::uint32_t> new_index(plant.axes.size(), kNone);
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < plant.axes.size(); ++i) {
    if (!plant.is_cut(plant.axes[i].first)) new_index[i] = count++;
  }
  return new_index;
}

std::vector<std::uint32_t> numbered_nodes(const Plant& plant) {
  std::vector<std::uint32_t> new_index(plant.node_count(), kNone);
  std::uint32_t count = 0;
  for (std::size_t node = 0; node < plant.node_count(); ++node) {
    if (!plant.is_cut(node)) new_index[node] = count++;
  }
  return new_index;
}

void close_nodes(Plant& plant) {
  const std::vector<std::uint32_t> new_axis = numbered_axes(plant);
  const std::vector<std::uint32_t> new_node = numbered_nodes(plant);
  close_holes(plant.axes, new_axis);
  for (Axis& axis : plant.axes) {
    axis.base = new_node[axis.base];
    axis.first = new_node[axis.first];
  }
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
