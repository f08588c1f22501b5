#include "growth/light_sums.h"

#include <algorithm>
#include <span>

namespace ramify::growth {
namespace {

constexpr std::size_t kClearedAhead = 256;  // nodes: some kilobytes of sums

}  // namespace

void sum_light(const Plant& plant, const std::vector<double>& light, std::vector<LightSum>& sums) {
  if (sums.capacity() < plant.node_count()) sums.clear();  // it is to move, and nothing of it is kept
  set_size(sums, plant.node_count());
  // Cleared a little ahead of the buds, which stand by node: so the sums come from memory once.
  std::size_t cleared = 0;
  const auto clear_to = [&](std::size_t end) {
    const std::size_t last = std::min(end, sums.size());
    std::fill(sums.begin() + cleared, sums.begin() + last, LightSum{});
    cleared = last;
  };
  for (std::size_t i = 0; i < plant.buds.size(); ++i) {
    const Bud& bud = plant.buds[i];
    if (bud.node >= cleared) clear_to(bud.node + kClearedAhead);
    LightSum& own = sums[bud.node];
    own.light[side_of(bud)] += light[i];
    ++own.buds;
  }
  clear_to(sums.size());
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
    sums[plant.buds[i].node] += values[i];
  }
  for (std::size_t node = sums.size(); node-- > 1;) {
    if (!plant.is_cut(node)) sums[plant.parent[node]] += sums[node];
  }
  return sums;
}

}  // namespace ramify::growth
