#include "growth/light_sums.h"

#include <algorithm>
#include <span>

#include "common/base/parallel.h"

namespace ramify::growth {
namespace {

constexpr std::size_t kBudsPerTask = 8192;
constexpr std::size_t kClearedAhead = 256;  // nodes: some kilobytes of sums

/// Of this size; what they were before is lost where they move.
template <class T>
void for_new_values(MappedVector<T>& values, std::size_t size) {
  if (values.capacity() < size) values.clear();
  set_size(values, size);
}

/// Sets the sums to what the buds at each node have. On all threads: buds stand by node, and each task takes
/// all buds of its nodes.
void sum_buds(const Plant& plant, const MappedVector<double>& light, MappedVector<Sides>& sums) {
  const auto& buds = plant.buds;
  if (buds.empty()) std::fill(sums.begin(), sums.end(), Sides{});
  const auto first_at_node = [&](std::size_t i) {
    while (i > 0 && i < buds.size() && buds[i].node == buds[i - 1].node) ++i;
    return i;
  };
  const auto first_node = [&](std::size_t i) {
    if (i == 0) return std::size_t{0};
    return i < buds.size() ? std::size_t{buds[i].node} : sums.size();
  };
  parallel_for(buds.size(), kBudsPerTask, [&](std::size_t begin, std::size_t end) {
    begin = first_at_node(begin);
    end = first_at_node(end);
    if (begin >= end) return;
    // Cleared a little ahead of the buds: so the sums come from memory once.
    std::size_t cleared = first_node(begin);
    const std::size_t last = first_node(end);
    const auto clear_to = [&](std::size_t node) {
      const std::size_t next = std::min(node, last);
      std::fill(sums.begin() + cleared, sums.begin() + next, Sides{});
      cleared = next;
    };
    for (std::size_t i = begin; i < end; ++i) {
      const Bud& bud = buds[i];
      if (bud.node >= cleared) clear_to(bud.node + kClearedAhead);
      sums[bud.node][side_of(bud)] += light[i];
    }
    clear_to(last);
  });
}

}  // namespace

void sum_light(const Plant& plant, const MappedVector<double>& light, LightSums& sums) {
  const std::size_t count = plant.node_count();
  for_new_values(sums.light, count);
  for_new_values(sums.internodes, count);
  const std::span parent(plant.parent);
  const auto gather_light = [&] {
    sum_buds(plant, light, sums.light);
    const std::span founds_axis(plant.founds_axis);
    const std::span of_light(sums.light);
    for (std::size_t node = count; node-- > 1;) {
      if (parent[node] == kNone) continue;
      of_light[parent[node]][founds_axis[node]] += of_light[node][kMain] + of_light[node][kLateral];
    }
  };
  const auto count_internodes = [&] {
    std::fill(sums.internodes.begin(), sums.internodes.end(), 0);
    const std::span internodes(sums.internodes);
    for (std::size_t node = count; node-- > 1;) {
      if (parent[node] != kNone) internodes[parent[node]] += ++internodes[node];
    }
  };
  side_by_side(gather_light, count_internodes);
}

std::vector<std::uint32_t> bud_counts(const Plant& plant) {
  std::vector<std::uint32_t> counts(plant.node_count(), 0);
  for (const Bud& bud : plant.buds) ++counts[bud.node];
  for (std::size_t node = counts.size(); node-- > 1;) {
    if (!plant.is_cut(node)) counts[plant.parent[node]] += counts[node];
  }
  return counts;
}

std::vector<double> subtree_sums(const Plant& plant, const MappedVector<double>& values) {
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
