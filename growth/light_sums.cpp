#include "growth/light_sums.h"

namespace ramify::growth {

void sum_light(const Plant& plant, const std::vector<double>& light, std::vector<LightSum>& sums) {
  // The tree grows: room for some steps at once.
  if (sums.capacity() < plant.node_count()) sums.reserve(plant.node_count() + plant.node_count() / 2);
  sums.assign(plant.node_count(), {});
  for (std::size_t i = 0; i < plant.buds.size(); ++i) {
    const Bud& bud = plant.buds[i];
    if (bud.is_dead()) continue;
    LightSum& sum = sums[bud.node];
    (bud.is_terminal ? sum.main : sum.lateral) += light[i];
    ++sum.buds;
  }
  for (std::size_t node = plant.node_count(); node-- > 1;) {
    const std::uint32_t parent = plant.parent[node];
    if (parent == kNone) continue;
    LightSum& own = sums[node];
    LightSum& below = sums[parent];
    (plant.founds_axis[node] ? below.lateral : below.main) += own.total();
    below.buds += own.buds;
    below.internodes += ++own.internodes;
  }
}

std::vector<double> subtree_sums(const Plant& plant, const std::vector<double>& values) {
  std::vector<double> sums(plant.node_count(), 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!plant.buds[i].is_dead()) sums[plant.buds[i].node] += values[i];
  }
  for (std::size_t node = sums.size(); node-- > 1;) {
    if (!plant.is_cut(node)) sums[plant.parent[node]] += sums[node];
  }
  return sums;
}

}  // namespace ramify::growth
