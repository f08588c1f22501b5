#include <algorithm>

#include "common/analysis/measures.h"
#include "common/analysis/statistics.h"

namespace ramify {

std::vector<std::optional<double>> tortuosities(const Anatomy& stem) {
  constexpr std::size_t kLeastInternodes = 3;
  const Skeleton& s = stem.skeleton();
  std::vector<std::optional<double>> result(stem.axis_count());
  for (std::size_t index = 0; index < stem.axis_count(); ++index) {
    const auto nodes = stem.axis(index);
    if (nodes.size() < kLeastInternodes) continue;
    double arc = 0.0;
    for (const std::uint32_t node : nodes) arc += s.length(node);
    const double chord = glm::distance(s.position[s.parent[nodes.front()]], s.position[nodes.back()]);
    if (chord > 0.0) result[index] = arc / chord;
  }
  return result;
}

void measure_paths(const Anatomy& stem, Metrics& metrics) {
  std::vector<double> crooked;
  for (const std::optional<double>& tortuosity : tortuosities(stem)) {
    if (tortuosity) crooked.push_back(*tortuosity);
  }
  metrics.tortuosity_mean = mean(crooked);

  std::vector<double> lengths;
  for (const std::uint32_t tip : stem.tips()) lengths.push_back(stem.path_lengths()[tip]);
  if (lengths.empty()) return;
  metrics.path_length_mean = mean(lengths);
  metrics.path_length_max = *std::max_element(lengths.begin(), lengths.end());
  if (*metrics.path_length_max > 0.0) {
    metrics.path_fraction = *metrics.path_length_mean / *metrics.path_length_max;
  }
}

}  // namespace ramify
