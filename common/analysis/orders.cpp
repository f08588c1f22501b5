#include "common/analysis/measures.h"
#include "common/analysis/statistics.h"

namespace ramify {

void measure_orders(const Anatomy& stem, Metrics& metrics) {
  if (!metrics.max_order) return;
  const Skeleton& s = stem.skeleton();
  const auto count = static_cast<std::size_t>(*metrics.max_order) + 1;
  metrics.by_order.resize(count);
  std::vector<std::vector<double>> angles(count);
  std::vector<std::vector<double>> crooked(count);
  const std::vector<std::optional<double>> angle = branching_angles_deg(stem);
  const std::vector<std::optional<double>> tortuosity = tortuosities(stem);
  for (std::size_t index = 0; index < stem.axis_count(); ++index) {
    const std::uint16_t order = stem.axis_order(index);
    OrderMetrics& own = metrics.by_order[order];
    ++own.axes;
    for (const std::uint32_t node : stem.axis(index)) {
      own.length += s.length(node);
      own.volume += cone_of(stem, node).volume;
    }
    if (angle[index]) angles[order].push_back(*angle[index]);
    if (tortuosity[index]) crooked[order].push_back(*tortuosity[index]);
  }
  for (std::size_t order = 0; order < count; ++order) {
    OrderMetrics& own = metrics.by_order[order];
    own.order = static_cast<std::uint16_t>(order);
    own.angle_mean_deg = mean(angles[order]);
    own.angle_median_deg = quantile(std::move(angles[order]), 0.5);
    own.tortuosity_mean = mean(crooked[order]);
  }
}

}  // namespace ramify
