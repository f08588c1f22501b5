#include "cli/experiment/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/analysis/anatomy.h"
#include "common/analysis/measures.h"
#include "common/analysis/statistics.h"
#include "common/base/parallel.h"

namespace ramify::cli {
namespace {

TreeDistributions distributions_of(const Skeleton& whole) {
  const Skeleton s = living_stem(whole);
  const Anatomy stem(s);
  TreeDistributions result;
  for (const std::optional<double>& angle : branching_angles_deg(stem)) {
    if (angle) result.branching_angles_deg.push_back(*angle);
  }
  for (const std::uint32_t tip : stem.tips()) result.path_lengths.push_back(stem.path_lengths()[tip]);
  std::vector<std::vector<double>> widths;
  for (std::size_t axis = 0; axis < stem.axis_count(); ++axis) {
    const auto nodes = stem.axis(axis);
    const double base = stem.path_lengths()[s.parent[nodes.front()]];
    result.axis_lengths.push_back(stem.path_lengths()[nodes.back()] - base);
    const std::size_t order = stem.axis_order(axis);
    if (widths.size() <= order) widths.resize(order + 1);
    widths[order].push_back(2.0 * s.start_radius(nodes.front()));
  }
  for (const std::vector<double>& own : widths) result.widths_by_order.push_back(mean(own).value_or(0.0));
  return result;
}

/// 0 where the values differ by rounding alone.
std::optional<double> deviation_of(const std::vector<double>& values) {
  const std::optional<double> deviation = standard_deviation(values);
  if (deviation && *deviation <= 1e-12 * std::abs(*mean(values))) return 0.0;
  return deviation;
}

MetricComparison compare_metric(const MetricInfo& info, std::span<const Subject> subjects) {
  MetricComparison result;
  result.info = &info;
  std::vector<double> variances;
  int defined = 0;  // subjects that have a mean
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    std::vector<double> values;
    for (const Sample& sample : subjects[i].samples) {
      if (const auto value = info.value(sample.metrics)) values.push_back(*value);
    }
    result.mean.push_back(mean(values));
    result.deviation.push_back(deviation_of(values));
    if (const auto deviation = result.deviation.back()) variances.push_back(*deviation * *deviation);
    if (!result.mean[i]) continue;
    if (++defined == 1) result.lowest = result.highest = i;
    if (*result.mean[i] < *result.mean[result.lowest]) result.lowest = i;
    if (*result.mean[i] > *result.mean[result.highest]) result.highest = i;
  }
  if (defined > 1) result.difference = *result.mean[result.highest] - *result.mean[result.lowest];
  if (const auto variance = mean(variances)) result.spread = std::sqrt(*variance);
  if (!result.spread || !result.difference) return result;
  if (*result.spread > 0.0) {
    result.factor = *result.difference / *result.spread;
  } else {
    result.factor = *result.difference > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
  }
  return result;
}

}  // namespace

Sample sample_of(const Skeleton& skeleton, std::uint64_t seed) {
  return {seed, measure(skeleton), form_of(skeleton), distributions_of(skeleton)};
}

std::vector<MetricComparison> compare_metrics(std::span<const Subject> subjects) {
  std::vector<MetricComparison> result;
  for (const MetricInfo& info : metric_table()) result.push_back(compare_metric(info, subjects));
  return result;
}

std::vector<PairDistance> pair_distances(std::span<const Subject> subjects,
                                         const std::function<void(std::size_t, std::size_t)>& report) {
  std::vector<std::pair<std::size_t, std::size_t>> trees;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    for (std::size_t k = 0; k < subjects[i].samples.size(); ++k) trees.emplace_back(i, k);
  }
  std::vector<PairDistance> pairs;
  for (std::size_t a = 0; a < trees.size(); ++a) {
    for (std::size_t b = a + 1; b < trees.size(); ++b) {
      pairs.push_back({trees[a].first, trees[a].second, trees[b].first, trees[b].second, {}});
    }
  }
  constexpr std::size_t kAtOnce = 32;  // between two reports
  for (std::size_t first = 0; first < pairs.size(); first += kAtOnce) {
    report(first, pairs.size());
    parallel_for(std::min(kAtOnce, pairs.size() - first), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = first + begin; i < first + end; ++i) {
        const TreeForm& a = subjects[pairs[i].subject_a].samples[pairs[i].sample_a].form;
        const TreeForm& b = subjects[pairs[i].subject_b].samples[pairs[i].sample_b].form;
        pairs[i].values = distances_of(a, b);
      }
    });
  }
  return pairs;
}

std::optional<double> mean_distance(std::span<const PairDistance> pairs, std::size_t distance, std::size_t a,
                                    std::size_t b) {
  std::vector<double> values;
  for (const PairDistance& pair : pairs) {
    const bool is_meant =
        (pair.subject_a == a && pair.subject_b == b) || (pair.subject_a == b && pair.subject_b == a);
    if (is_meant) values.push_back(pair.values[distance]);
  }
  return mean(values);
}

std::optional<double> between_over_within(std::span<const PairDistance> pairs, std::size_t distance,
                                          std::size_t a, std::size_t b) {
  std::vector<double> within;
  for (const std::size_t subject : {a, b}) {
    if (const auto own = mean_distance(pairs, distance, subject, subject)) within.push_back(*own);
  }
  const std::optional<double> between = mean_distance(pairs, distance, a, b);
  const std::optional<double> mean_within = mean(within);
  if (!between || !mean_within || *mean_within == 0.0) return std::nullopt;
  return *between / *mean_within;
}

}  // namespace ramify::cli
