#include <algorithm>
#include <cmath>

#include "common/analysis/measures.h"
#include "common/analysis/statistics.h"

namespace ramify {
namespace {

constexpr double kBreastHeight = 1.3;    // metres: where foresters measure a trunk
constexpr double kCrownFraction = 0.95;  // of the tips: the outermost twig alone is a matter of chance

double height_above_root(const Anatomy& stem, std::size_t node) {
  const Skeleton& s = stem.skeleton();
  return s.position[node].y - s.position[stem.root_of()[node]].y;
}

/// Of the thickest internode that passes breast height, at that height.
std::optional<double> breast_height_diameter(const Anatomy& stem) {
  const Skeleton& s = stem.skeleton();
  std::optional<double> widest;
  for (std::size_t node = s.root_count(); node < s.node_count(); ++node) {
    const double start = height_above_root(stem, s.parent[node]);
    const double end = height_above_root(stem, node);
    if (!(start <= kBreastHeight && kBreastHeight <= end && start < end)) continue;
    const double part = (kBreastHeight - start) / (end - start);
    const double diameter = (1.0 - part) * 2.0 * s.start_radius(node) + part * s.diameter[node];
    widest = std::max(widest.value_or(0.0), diameter);
  }
  return widest;
}

}  // namespace

void measure_size(const Anatomy& stem, Metrics& metrics) {
  const Skeleton& s = stem.skeleton();
  if (s.internode_count() == 0) return;
  Box all;
  Box crown;
  std::uint16_t max_order = 0;
  for (std::size_t node = 0; node < s.node_count(); ++node) {
    all.include(s.position[node]);
    if (s.is_root(node)) continue;
    max_order = std::max(max_order, s.order[node]);
    if (s.order[node] > 0) crown.include(s.position[node]);
    const bool is_at_base = s.is_root(s.parent[node]);
    if (is_at_base) metrics.trunk_diameter = std::max(metrics.trunk_diameter.value_or(0.0), s.diameter[node]);
  }
  std::vector<double> reaches;
  for (const std::uint32_t tip : stem.tips()) {
    const Vec3 from_root = s.position[tip] - s.position[stem.root_of()[tip]];
    reaches.push_back(std::hypot(from_root.x, from_root.z));
  }
  metrics.max_order = max_order;
  metrics.height = all.size().y;
  metrics.crown_radius = quantile(std::move(reaches), kCrownFraction);
  if (!crown.is_empty()) metrics.crown_height = crown.size().y;
  metrics.crown_volume = hull_volume(stem);
  metrics.dbh = breast_height_diameter(stem);
}

}  // namespace ramify
