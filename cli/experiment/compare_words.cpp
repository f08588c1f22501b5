#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "cli/experiment/compare_report.h"
#include "cli/text.h"

namespace ramify::cli {
namespace {

constexpr std::size_t kNamedInFull = 5;

std::string words_of(std::string_view key) {
  std::string words(key);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string with_unit(const MetricInfo& info, double value) {
  const std::string unit = info.unit == "deg" ? "degrees" : std::string(info.unit);
  const std::string number = short_number(value);
  return unit.empty() ? number : number + " " + unit;
}

/// "height 9.1 m (s4-fig8) against 10.6 m (xm12-fig5)".
std::string contrast(const MetricComparison& metric, const CompareResults& results) {
  return fmt::format(
      "{} {} ({}) against {} ({})", words_of(metric.info->key),
      with_unit(*metric.info, *metric.mean[metric.lowest]), results.subjects[metric.lowest].label,
      with_unit(*metric.info, *metric.mean[metric.highest]), results.subjects[metric.highest].label);
}

/// The part of the larger mean that the difference is.
double relative_difference(const MetricComparison& metric) {
  const double larger =
      std::max(std::abs(*metric.mean[metric.lowest]), std::abs(*metric.mean[metric.highest]));
  return larger > 0.0 ? *metric.difference / larger : 0.0;
}

/// Metrics that all subjects define; the number of nodes says what that of the internodes says.
std::vector<const MetricComparison*> comparable(const CompareResults& results) {
  std::vector<const MetricComparison*> found;
  for (const MetricComparison& metric : results.metrics) {
    const bool is_defined =
        std::all_of(metric.mean.begin(), metric.mean.end(), [](const auto& m) { return !!m; });
    if (is_defined && metric.info->key != "nodes") found.push_back(&metric);
  }
  return found;
}

std::string without_seeds(const CompareResults& results) {
  std::vector<const MetricComparison*> metrics = comparable(results);
  std::stable_sort(metrics.begin(), metrics.end(), [](const MetricComparison* a, const MetricComparison* b) {
    return relative_difference(*a) > relative_difference(*b);
  });
  std::string text =
      "There is one tree of each input, so how much the seeds of one differ is not known; with --seeds 8 it "
      "is. ";
  std::vector<std::string> most;
  for (const MetricComparison* metric : metrics) {
    if (most.size() == kNamedInFull || relative_difference(*metric) == 0.0) break;
    most.push_back(
        fmt::format("{}, {:.0f} % less", contrast(*metric, results), 100 * relative_difference(*metric)));
  }
  if (most.empty()) return text + "No metric differs.";
  return text + fmt::format("The greatest differences: {}.", fmt::join(most, "; "));
}

std::string with_seeds(const CompareResults& results) {
  std::vector<const MetricComparison*> all = comparable(results);
  std::erase_if(all, [](const MetricComparison* metric) { return !metric->factor; });
  std::vector<const MetricComparison*> different = all;
  std::erase_if(different, [](const MetricComparison* metric) { return !(*metric->factor > 1.0); });
  std::stable_sort(
      different.begin(), different.end(),
      [](const MetricComparison* a, const MetricComparison* b) { return *a->factor > *b->factor; });
  if (different.empty()) {
    return fmt::format("None of {} metrics differs by more than the spread between seeds.", all.size());
  }
  std::vector<std::string> most;
  std::vector<std::string> others;
  for (const MetricComparison* metric : different) {
    if (most.size() < kNamedInFull) {
      most.push_back(fmt::format("{}, {}", contrast(*metric, results), factor_text(*metric->factor, true)));
    } else {
      others.push_back(
          fmt::format("{} ({})", words_of(metric->info->key), factor_text(*metric->factor, false)));
    }
  }
  std::vector<std::string> alike;
  for (const MetricComparison* metric : all) {
    if (!(*metric->factor > 1.0)) alike.push_back(words_of(metric->info->key));
  }
  std::string text =
      fmt::format("{} of {} metrics differ by more than the spread between seeds. Most of all: {}.",
                  different.size(), all.size(), fmt::join(most, "; "));
  if (!others.empty()) text += fmt::format(" Also: {}.", fmt::join(others, ", "));
  if (!alike.empty()) text += fmt::format(" No more than seeds do: {}.", fmt::join(alike, ", "));
  return text;
}

/// How far the two nearest and the two farthest subjects are apart, in units of what seeds make.
std::string distances_in_words(const CompareResults& results) {
  std::string text;
  for (std::size_t k = 0; k < kDistanceCount; ++k) {
    std::vector<double> ratios;
    for (std::size_t a = 0; a < results.subjects.size(); ++a) {
      for (std::size_t b = a + 1; b < results.subjects.size(); ++b) {
        if (const auto ratio = between_over_within(results.pairs, k, a, b)) ratios.push_back(*ratio);
      }
    }
    if (ratios.empty()) return "";
    const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
    const std::string range =
        ratios.size() == 1 ? fmt::format("{:.1f}", *least) : fmt::format("{:.1f} to {:.1f}", *least, *most);
    text += fmt::format("{}{}{} by {}", k == 0 ? "" : (k + 1 == kDistanceCount ? " and " : ", "), range,
                        k == 0 ? " times as far from each other" : "", distance_table()[k].key);
  }
  return fmt::format(" Measured against two seeds of one input, trees of different inputs are {}.", text);
}

}  // namespace

std::string differences_in_words(const CompareResults& results) {
  const bool has_spread =
      std::any_of(results.metrics.begin(), results.metrics.end(),
                  [](const MetricComparison& metric) { return metric.spread.has_value(); });
  return has_spread ? with_seeds(results) + distances_in_words(results) : without_seeds(results);
}

}  // namespace ramify::cli
