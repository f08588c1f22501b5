// Numbers that describe a tree, for comparing made trees with each other and with measured ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/skeleton/skeleton.h"

namespace ramify {

/// One branch order's share. 0 is the trunk.
struct OrderMetrics {
  std::uint16_t order = 0;
  std::size_t axes = 0;
  double length = 0.0;                     // metres
  double volume = 0.0;                     // m3
  std::optional<double> angle_mean_deg;    // branching angles
  std::optional<double> angle_median_deg;  //
  std::optional<double> tortuosity_mean;
};

/// Nothing where the tree does not define a value. Metres, m2, m3; metric_table() says what each one is.
struct Metrics {
  std::size_t nodes = 0;
  std::size_t internodes = 0;
  std::size_t axes = 0;
  std::optional<double> max_order;
  std::optional<double> height;
  std::optional<double> crown_radius;
  std::optional<double> crown_height;
  std::optional<double> crown_volume;
  std::optional<double> trunk_diameter;
  std::optional<double> dbh;
  double total_length = 0.0;
  double wood_volume = 0.0;
  double surface_area = 0.0;
  std::optional<double> strahler_order;
  std::optional<double> bifurcation_ratio;
  std::optional<double> length_ratio;
  std::optional<double> diameter_ratio;
  std::optional<double> branching_angle_mean_deg;
  std::optional<double> branching_angle_sd_deg;
  std::optional<double> divergence_angle_mean_deg;
  std::optional<double> internode_length_mean;
  std::optional<double> tortuosity_mean;
  std::optional<double> path_length_mean;
  std::optional<double> path_length_max;
  std::optional<double> path_fraction;
  std::optional<double> fractal_dimension;
  std::optional<double> asymmetry;
  std::optional<double> lean;
  std::optional<double> pipe_exponent;
  std::vector<OrderMetrics> by_order;  // from 0 on, none left out
};

/// Measures the living part of a tree. Counts, length, volume, surface and centre of mass are of all wood,
/// the rest of the stem without the roots below the ground. The skeleton must be sound (violations()). O(n
/// log n).
Metrics measure(const Skeleton& skeleton);

/// The part of a tree that is alive and no root below the ground; root nodes stay.
Skeleton living_stem(const Skeleton& skeleton);

/// What a metric is called and means.
struct MetricInfo {
  std::string_view key;
  std::string_view unit;       // empty for pure numbers
  std::string_view help;       // one line
  std::string_view reference;  // what real trees have, and who says so; may be empty
  bool is_count = false;       // a whole number
  std::optional<double> (*value)(const Metrics& metrics) = nullptr;
};

/// Every metric but by_order, in the order in which they are listed.
std::span<const MetricInfo> metric_table();

}  // namespace ramify
