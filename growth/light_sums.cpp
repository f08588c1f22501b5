#include "growth/light_sums.h"

#include <algorithm>
#include <span>

namespace ramify::growth {
namespace {

constexpr std::size_t kClearedAhead = 256;  // nodes: some kilobytes of sums

/// Of this size; what they were before is lost where they move.
template <class T>
void for_new_values(std::vector<T>& values, std::size_t size) {
  if (values.capacity() < size) values.clear();
  set_size(values, size);
}

}  // namespace

void sum_light(const Plant& plant, const std::vector<double>& light, LightSums& sums) {
  const std::size_t count = plant.node_count();
  for_new_values(sums.light, count);
  for_new_values(sums.internodes, count);
  // Cleared a little ahead of the buds, which stand by node: so the sums come from memory once.
  std::size_t cleared = 0;
  const auto clear_to = [&](std::size_t end) {
    const std::size_t last = std::min(end, count);
    std::fill(sums.light.begin() + cleared, sums.light.begin() + last, Sides{});
    cleared = last;
  };
  for (std::size_t i = 0; i < plant.buds.size(); ++i) {
    const Bud& bud = plant.buds[i];
    if (bud.node >= cleared) clear_to(bud.node + kClearedAhead);
    sums.light[bud.node][side_of(bud)] += light[i];
  }
  clear_to(count);

  std::fill(sums.internodes.begin(), sums.internodes.end(), 0);
  const std::span parent(plant.parent);
  const std::span founds_axis(plant.founds_axis);
  const std::span of_light(sums.light);
  const std::span internodes(sums.internodes);
  for (std::size_t node = count; node-- > 1;) {
    if (parent[node] == kNone) continue;
    of_light[parent[node]][founds_axis[node]] += of_light[node][kMain] + of_light[node][kLateral];
    internodes[parent[node]] += ++internodes[node];
  }
}

std::vector<std::uint32_t> bud_counts(const Plant& plant) {
  std::vector<std::uint32_t> counts(plant.node_count(), 0);
  for (const Bud& bud : plant.buds) ++counts[bud.node];
  for (std::size_t node = counts.size(); node-- > 1;) {
    if (!plant.is_cut(node)) counts[plant.parent[node]] += counts[node];
  }
  return counts;
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
