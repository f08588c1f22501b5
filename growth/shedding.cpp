#include "growth/shedding.h"

#include <algorithm>

namespace ramify::growth {

std::vector<std::uint32_t> shaded_axes(const Plant& plant, const LightSums& sums,
                                       const Parameters& parameters, int step) {
  const double threshold = parameters.shed_threshold.at(step);
  std::vector<std::uint32_t> shaded;
  if (threshold <= 0.0 || step <= parameters.shed_after) return shaded;
  for (std::uint32_t i = 1; i < plant.axes.size(); ++i) {
    const Axis& axis = plant.axes[i];
    if (axis.is_shed) continue;
    if (sums.total(axis.first) < threshold * sums.internodes[axis.first]) shaded.push_back(i);
  }
  return shaded;
}

std::vector<Coord> shed_axes(Plant& plant, const std::vector<std::uint32_t>& axes,
                             const Parameters& parameters, const ShadowGrid& shadow, int step) {
  std::vector<Coord> freed;
  if (axes.empty()) return freed;
  for (const std::uint32_t axis : axes) plant.axes[axis].is_shed = true;
  // An axis comes after the one it grows from, so one pass forward takes all axes along.
  for (std::size_t i = 1; i < plant.axes.size(); ++i) {
    if (plant.axes[plant.axis[plant.axes[i].base]].is_shed) plant.axes[i].is_shed = true;
  }

  for (std::size_t node = 1; node < plant.node_count(); ++node) {
    if (plant.shed_step[node] != kAlive || !plant.axes[plant.axis[node]].is_shed) continue;
    plant.shed_step[node] = static_cast<std::uint32_t>(step);
    if (parameters.casters == Casters::metamers) freed.push_back(shadow.voxel_of(plant.position[node]));
  }
  const auto is_shed = [&](const Bud& bud) { return plant.axes[bud.axis].is_shed; };
  if (parameters.casters == Casters::buds) {
    for (const Bud& bud : plant.buds) {
      if (is_shed(bud)) freed.push_back(shadow.voxel_of(plant.position[bud.node]));
    }
  }
  plant.buds.erase(std::remove_if(plant.buds.begin(), plant.buds.end(), is_shed), plant.buds.end());
  return freed;
}

}  // namespace ramify::growth
