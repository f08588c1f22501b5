#include "growth/light_sums.h"

#include <span>

namespace ramify::growth {

void sum_light(const Plant& plant, const std::vector<double>& light, std::vector<LightSum>& sums) {
  sums.clear();  // before it may move: nothing of it is kept
  make_room(sums, plant.node_count());
  sums.assign(plant.node_count(), {});
  for (std::size_t i = 0; i < plant.buds.size(); ++i) {
    const Bud& bud = plant.buds[i];
    if (bud.is_dead()) continue;
    LightSum& own = sums[bud.node];
    own.light[side_of(bud)] += light[i];
    ++own.buds;
  }
  const std::span parent(plant.parent);
  const std::span founds_axis(plant.founds_axis);
  const std::span all(sums);
  for (std::size_t node = plant.node_count(); node-- > 1;) {
    if (parent[node] == kNone) continue;
    LightSum& own = all[node];
    ++own.internodes;
    LightSum& below = all[parent[node]];
    below.light[founds_axis[node]] += own.total();
    below.buds += own.buds;
    below.internodes += own.internodes;
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
