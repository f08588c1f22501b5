#include <algorithm>
#include <numeric>
#include <span>

#include "growth/allocation.h"

namespace ramify::growth {
namespace {

/// A bud or a lateral axis on an axis's list.
struct Item {
  double total = 0.0;  // light of all its buds
  double rank = 0.0;   // what the list is sorted by, highest first
  std::uint32_t node = 0;
  std::uint32_t index = 0;  // of the bud or the axis
  bool is_axis = false;
  bool is_terminal = false;
};

/// The items of all axes, those of axis i from first[i] to first[i + 1] - 1.
struct Lists {
  std::vector<std::size_t> first;
  std::vector<Item> items;
};

Lists list_items(const Plant& plant, const MappedVector<double>& light, const LightSums& sums,
                 bool is_ranked_by_total) {
  const auto base_of = [&](const Axis& axis) { return plant.parent[axis.first]; };
  const auto host_of = [&](const Axis& axis) { return plant.axis[base_of(axis)]; };
  const std::vector<std::uint32_t> bud_count = bud_counts(plant);
  Lists lists;
  lists.first.assign(plant.axes.size() + 1, 0);
  for (const Bud& bud : plant.buds) {
    ++lists.first[plant.axis[bud.node] + 1];
  }
  for (std::size_t i = 1; i < plant.axes.size(); ++i) {
    if (!plant.is_cut(plant.axes[i].first)) ++lists.first[host_of(plant.axes[i]) + 1];
  }
  std::partial_sum(lists.first.begin(), lists.first.end(), lists.first.begin());

  lists.items.resize(lists.first.back());
  std::vector<std::size_t> next(lists.first.begin(), lists.first.end() - 1);
  for (std::uint32_t i = 0; i < plant.buds.size(); ++i) {
    const Bud& bud = plant.buds[i];
    lists.items[next[plant.axis[bud.node]]++] = {light[i], light[i], bud.node, i, false, bud.is_terminal};
  }
  for (std::uint32_t i = 1; i < plant.axes.size(); ++i) {
    const Axis& axis = plant.axes[i];
    if (plant.is_cut(axis.first)) continue;
    const double total = sums.total(axis.first);
    const std::uint32_t buds = bud_count[axis.first];
    const double mean = buds > 0 ? total / buds : 0.0;
    lists.items[next[host_of(axis)]++] = {total, is_ranked_by_total ? total : mean, base_of(axis), i, true,
                                          false};
  }
  return lists;
}

}  // namespace

double priority_weight(std::size_t i, std::size_t n, double w_max, double w_min, double kappa) {
  const double range = kappa * static_cast<double>(n);
  const double place = static_cast<double>(i);
  return place < range ? w_max - (w_max - w_min) * place / range : w_min;
}

void allocate_priority(const Plant& plant, const MappedVector<double>& light, const LightSums& sums,
                       const TreeParameters& tree, int step, MappedVector<double>& vigour) {
  const double w_max = tree.w_max.at(step);
  const double w_min = tree.w_min.at(step);
  const double kappa = tree.kappa.at(step);
  const bool is_terminal_first = step <= tree.terminal_first_until;
  const auto goes_before = [&](const Item& a, const Item& b) {
    if (is_terminal_first && a.is_terminal != b.is_terminal) return a.is_terminal;
    if (a.rank != b.rank) return a.rank > b.rank;
    if (a.node != b.node) return a.node > b.node;  // later nodes of an axis are nearer to its tip
    if (a.is_terminal != b.is_terminal) return a.is_terminal;
    return a.is_axis != b.is_axis ? b.is_axis : a.index < b.index;
  };

  const bool is_ranked_by_total = !is_terminal_first && tree.sort_after == SortAfter::total;
  Lists lists = list_items(plant, light, sums, is_ranked_by_total);
  std::vector<double> axis_vigour(plant.axes.size(), 0.0);
  axis_vigour[0] = root_vigour(sums, tree, step);
  vigour.assign(plant.buds.size(), 0.0);
  std::vector<double> demand;
  for (std::size_t axis = 0; axis < plant.axes.size(); ++axis) {
    const std::span<Item> items(lists.items.data() + lists.first[axis],
                                lists.first[axis + 1] - lists.first[axis]);
    std::sort(items.begin(), items.end(), goes_before);
    demand.resize(items.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < items.size(); ++i) {
      demand[i] = items[i].total * priority_weight(i + 1, items.size(), w_max, w_min, kappa);
      sum += demand[i];
    }
    if (!(sum > 0.0)) continue;
    for (std::size_t i = 0; i < items.size(); ++i) {
      const double share = axis_vigour[axis] * demand[i] / sum;
      (items[i].is_axis ? axis_vigour[items[i].index] : vigour[items[i].index]) = share;
    }
  }
}

}  // namespace ramify::growth
