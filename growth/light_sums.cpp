#include "growth/light_sums.h"

namespace ramify::growth {

void sum_light(const Plant& plant, const std::vector<double>& light, std::vector<LightSum>& sums) {
  if (sums.capacity() < plant.node_count()) {
    // The tree grows: room for some steps at once, and no copy of what is done with.
    std::vector<LightSum>().swap(sums);
    sums.reserve(plant.node_count() + plant.node_count() / 2);
  }
  sums.assign(plant.node_count(), {});
  std::size_t bud = plant.buds.size();
  for (std::size_t node = plant.node_count(); node-- > 0;) {
    LightSum& own = sums[node];
    for (; bud > 0 && plant.buds[bud - 1].node >= node; --bud) {
      if (plant.buds[bud - 1].is_dead()) continue;
      (plant.buds[bud - 1].is_terminal ? own.main : own.lateral) += light[bud - 1];
      ++own.buds;
    }
    const std::uint32_t parent = plant.parent[node];
    if (parent == kNone) continue;
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
