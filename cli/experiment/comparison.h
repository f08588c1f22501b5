// Trees set against each other: every metric and distance, between the inputs and between the seeds of one.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/analysis/distances.h"
#include "common/analysis/metrics.h"

namespace ramify::cli {

/// One value a branch, tip or order of a tree.
struct TreeDistributions {
  std::vector<double> branching_angles_deg;  // of axes that stand on others
  std::vector<double> axis_lengths;          // metres
  std::vector<double> path_lengths;          // from the root to each tip, metres
  std::vector<double> widths_by_order;       // mean diameter at the base of the axes of each order, metres
};

/// One tree, measured.
struct Sample {
  std::uint64_t seed = 0;  // 0 for a tree from a file
  Metrics metrics;
  TreeForm form;
  TreeDistributions distributions;
};

Sample sample_of(const Skeleton& skeleton, std::uint64_t seed);

/// One input: trees of one config by seed, or one tree from a file.
struct Subject {
  std::string label;
  std::vector<Sample> samples;
};

/// A metric over all subjects; one entry a subject, nothing where its trees do not define the value.
struct MetricComparison {
  const MetricInfo* info = nullptr;
  std::vector<std::optional<double>> mean;
  std::vector<std::optional<double>> deviation;  // between the seeds of a subject; needs two of them
  std::optional<double> spread;                  // root mean square of the deviations
  std::size_t lowest = 0;                        // the subjects that differ most, by their means
  std::size_t highest = 0;
  std::optional<double> difference;  // of their means; needs two
  /// How many times the spread the difference is; infinite if the seeds make no difference, 0 if nothing
  /// does.
  std::optional<double> factor;
};

std::vector<MetricComparison> compare_metrics(std::span<const Subject> subjects);

/// Two trees: subject and sample of each.
struct PairDistance {
  std::size_t subject_a = 0;
  std::size_t sample_a = 0;
  std::size_t subject_b = 0;
  std::size_t sample_b = 0;
  std::array<double, kDistanceCount> values{};
};

/// All pairs of trees, each once. `report(done, total)` is called now and then on the calling thread; what it
/// throws ends the work.
std::vector<PairDistance> pair_distances(std::span<const Subject> subjects,
                                         const std::function<void(std::size_t, std::size_t)>& report);

/// Mean over pairs of trees of two subjects; of one and the same, over pairs of its seeds. Nothing if there
/// is no such pair.
std::optional<double> mean_distance(std::span<const PairDistance> pairs, std::size_t distance, std::size_t a,
                                    std::size_t b);

/// The mean distance between two subjects over that within them. Nothing if neither has two trees or all
/// their trees are the same.
std::optional<double> between_over_within(std::span<const PairDistance> pairs, std::size_t distance,
                                          std::size_t a, std::size_t b);

}  // namespace ramify::cli
