#include "common/analysis/metrics.h"

#include <algorithm>
#include <array>

#include "common/analysis/measures.h"
#include "common/skeleton/passes.h"

namespace ramify {
namespace {

template <auto Member>
std::optional<double> value_of(const Metrics& metrics) {
  if constexpr (std::is_same_v<std::decay_t<decltype(metrics.*Member)>, std::size_t>) {
    return static_cast<double>(metrics.*Member);
  } else {
    return metrics.*Member;
  }
}

template <auto Member>
constexpr MetricInfo metric(std::string_view key, std::string_view unit, std::string_view help,
                            std::string_view reference = "") {
  return {key, unit, help, reference, false, &value_of<Member>};
}

template <auto Member>
constexpr MetricInfo count(std::string_view key, std::string_view help) {
  return {key, "", help, "", true, &value_of<Member>};
}

constexpr std::array kMetrics = {
    count<&Metrics::nodes>("nodes", "Nodes, the roots among them"),
    count<&Metrics::internodes>("internodes", "Internodes alive"),
    count<&Metrics::axes>("axes", "Axes: trunk, branches, twigs"),
    count<&Metrics::max_order>("max_order", "Highest branch order; the trunk has 0"),
    metric<&Metrics::height>("height", "m", "From the lowest to the highest node", "7-18 (30 years old)"),
    metric<&Metrics::crown_radius>("crown_radius", "m",
                                   "Horizontal distance from the root that 95 % of the tips keep within",
                                   "1.5-5 (30 years old)"),
    metric<&Metrics::crown_height>("crown_height", "m", "From the lowest to the highest node of a branch"),
    metric<&Metrics::crown_volume>("crown_volume", "m3", "Convex hull of the tips"),
    metric<&Metrics::trunk_diameter>("trunk_diameter", "m", "At the base", "0.10-0.35 (30 years old)"),
    metric<&Metrics::dbh>("dbh", "m", "Trunk diameter 1.3 m above the root"),
    metric<&Metrics::total_length>("total_length", "m", "All internodes together"),
    metric<&Metrics::wood_volume>("wood_volume", "m3", "All internodes as truncated cones"),
    metric<&Metrics::surface_area>("surface_area", "m2", "Bark of the truncated cones"),
    count<&Metrics::strahler_order>("strahler_order", "Horton-Strahler order of the trunk; tips have 1"),
    metric<&Metrics::bifurcation_ratio>("bifurcation_ratio", "",
                                        "Horton: streams of an order to those of the next",
                                        "3-5 (Prusinkiewicz, Lindenmayer 1990)"),
    metric<&Metrics::length_ratio>("length_ratio", "",
                                   "Horton: mean stream length of an order to the one before"),
    metric<&Metrics::diameter_ratio>("diameter_ratio", "",
                                     "Horton: mean stream diameter of an order to the one before"),
    metric<&Metrics::branching_angle_mean_deg>("branching_angle_mean", "deg",
                                               "Between an axis and the internode that bears it",
                                               "50-90 at order 1 (Honda 1971)"),
    metric<&Metrics::branching_angle_sd_deg>("branching_angle_sd", "deg", "Its standard deviation"),
    metric<&Metrics::divergence_angle_mean_deg>("divergence_angle_mean", "deg",
                                                "Azimuth step between successive laterals",
                                                "130-145 spiral, 80-100 decussate"),
    metric<&Metrics::internode_length_mean>("internode_length_mean", "m", "Total length over internodes"),
    metric<&Metrics::tortuosity_mean>("tortuosity_mean", "",
                                      "Arc over chord of axes of 3 internodes or more"),
    metric<&Metrics::path_length_mean>("path_length_mean", "m", "From the root to the tips, mean"),
    metric<&Metrics::path_length_max>("path_length_max", "m", "From the root to the tips, longest"),
    metric<&Metrics::path_fraction>("path_fraction", "", "Mean path length over the longest",
                                    "0.36-0.93 (Smith et al. 2014)"),
    metric<&Metrics::fractal_dimension>("fractal_dimension", "",
                                        "By counting boxes of 1/4 to 1/128 of the height", "1-2.3"),
    metric<&Metrics::asymmetry>("asymmetry", "",
                                "Of the forks' tips (Van Pelt et al. 1992); 0 even, 1 herringbone"),
    metric<&Metrics::lean>("lean", "", "The wood's centre of mass aside of the root, over the height"),
    metric<&Metrics::pipe_exponent>("pipe_exponent", "", "n of d^n = d1^n + d2^n, median over forks",
                                    "1.5-2.8"),
};

bool has_roots_below(const Skeleton& s) {
  for (std::size_t node = s.root_count(); node < s.node_count(); ++node) {
    if (s.kind[node] == Kind::root) return true;
  }
  return false;
}

void measure_stem(const Anatomy& stem, Metrics& metrics) {
  measure_size(stem, metrics);
  measure_streams(stem, metrics);
  measure_angles(stem, metrics);
  measure_paths(stem, metrics);
  measure_dimension(stem, metrics);
  measure_forks(stem, metrics);
  measure_orders(stem, metrics);
}

}  // namespace

Skeleton living_stem(const Skeleton& skeleton) {
  std::vector<bool> keep(skeleton.node_count());
  for (std::size_t node = 0; node < skeleton.node_count(); ++node) {
    const bool is_stem = skeleton.is_root(node) || skeleton.kind[node] == Kind::stem;
    keep[node] = is_stem && !skeleton.is_shed(node);
  }
  return subset(skeleton, keep);
}

Metrics measure(const Skeleton& skeleton) {
  const bool has_shed = std::any_of(skeleton.shed_step.begin(), skeleton.shed_step.end(),
                                    [](std::uint32_t step) { return step != kAlive; });
  if (has_shed) return measure(living(skeleton));
  Metrics metrics;
  const Anatomy wood(skeleton);
  if (has_roots_below(skeleton)) {
    const Skeleton stem = living_stem(skeleton);
    measure_stem(Anatomy(stem), metrics);
  } else {
    measure_stem(wood, metrics);
  }
  measure_wood(wood, metrics);
  return metrics;
}

std::span<const MetricInfo> metric_table() {
  return kMetrics;
}

}  // namespace ramify
