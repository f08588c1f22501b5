#include "pathplan/widths.h"

#include <algorithm>
#include <cmath>

#include "common/skeleton/passes.h"

namespace ramify::pathplan {
namespace {

constexpr double kNone = -1.0;

/// Greatest length walked from one of the tips to each node, metres; kNone where there is none.
std::vector<double> walked_lengths(const Skeleton& tree, std::span<const std::uint32_t> tips) {
  std::vector<double> walked(tree.node_count(), kNone);
  for (const std::uint32_t tip : tips) walked[tip] = 0.0;
  for (std::size_t node = tree.node_count(); node-- > 1;) {
    if (walked[node] == kNone) continue;
    double& below = walked[tree.parent[node]];
    below = std::max(below, walked[node] + tree.length(node));
  }
  return walked;
}

void scale_widths(Skeleton& tree, double trunk_diameter, double tip_diameter) {
  const double scale = tree.diameter[0] > 0.0 ? trunk_diameter / tree.diameter[0] : 0.0;
  for (double& diameter : tree.diameter) diameter = std::max(tip_diameter, scale * diameter);
  tree.diameter[0] = trunk_diameter;
}

}  // namespace

void assign_tapered_widths(Skeleton& tree, std::span<const TaperedTips> levels, double edge_length,
                           double trunk_diameter, double tip_diameter) {
  tree.diameter.assign(tree.node_count(), 0.0);
  for (const TaperedTips& level : levels) {
    const std::vector<double> walked = walked_lengths(tree, level.nodes);
    for (std::size_t node = 0; node < tree.node_count(); ++node) {
      if (walked[node] == kNone) continue;
      tree.diameter[node] = std::max(tree.diameter[node], std::pow(walked[node] / edge_length, level.zeta));
    }
  }
  scale_widths(tree, trunk_diameter, tip_diameter);
}

void assign_piped_widths(Skeleton& tree, double exponent, double trunk_diameter, double tip_diameter) {
  assign_pipe_diameters(tree, {.exponent = exponent});
  tree.pipe_model.reset();  // the least diameter breaks the rule
  scale_widths(tree, trunk_diameter, tip_diameter);
}

}  // namespace ramify::pathplan
