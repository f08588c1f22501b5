#include "growth/shedding.h"

#include <algorithm>

#include "common/base/parallel.h"

namespace ramify::growth {
namespace {

constexpr std::size_t kAxesPerTask = 1 << 14;

/// 0: nothing is shed this way in this step.
double threshold_of(ShedBy way, const TreeParameters& tree, int step) {
  return tree.shed_by == way && step > tree.shed_after ? tree.shed_threshold.at(step) : 0.0;
}

}  // namespace

std::vector<std::uint32_t> shaded_axes(const Plant& plant, const LightSums& sums, const TreeParameters& tree,
                                       int step) {
  const double threshold = threshold_of(ShedBy::light, tree, step);
  if (threshold <= 0.0) return {};
  std::vector<std::vector<std::uint32_t>> shaded_of_task(plant.axes.size() / kAxesPerTask + 1);
  parallel_for(shaded_of_task.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t task = begin; task < end; ++task) {
      const std::size_t last = std::min((task + 1) * kAxesPerTask, plant.axes.size());
      for (std::size_t i = std::max<std::size_t>(task * kAxesPerTask, 1); i < last; ++i) {
        const std::uint32_t first = plant.axes[i].first;
        const bool is_shaded = sums.total(first) < threshold * sums.internodes[first];
        if (is_shaded && !plant.is_cut(first)) shaded_of_task[task].push_back(first);
      }
    }
  });
  std::vector<std::uint32_t> shaded;
  for (const auto& found : shaded_of_task) shaded.insert(shaded.end(), found.begin(), found.end());
  return shaded;
}

std::vector<std::uint32_t> starved_internodes(const Plant& plant, const LightSums& sums,
                                              const MappedVector<double>& vigour, const TreeParameters& tree,
                                              int step) {
  const double threshold = threshold_of(ShedBy::vigour, tree, step);
  std::vector<std::uint32_t> starved;
  if (threshold <= 0.0) return starved;
  const std::vector<double> received = subtree_sums(plant, vigour);
  for (std::uint32_t node = 1; node < plant.node_count(); ++node) {
    if (plant.is_cut(node)) continue;
    if (received[node] < threshold * sums.internodes[node]) starved.push_back(node);
  }
  return starved;
}

}  // namespace ramify::growth
