#include "cli/experiment/distributions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/text.h"
#include "common/analysis/statistics.h"

namespace ramify::cli {
namespace {

constexpr int kBins = 24;

/// Where bins begin and end, in units or, if logarithmic, in powers of ten of them.
struct Bins {
  double low = 0.0;
  double width = 1.0;
  int count = kBins;
  bool is_logarithmic = false;

  /// Where `bin` of them begin, which may be a fraction.
  double place(double bin) const {
    const double at = low + bin * width;
    return is_logarithmic ? std::pow(10.0, at) : at;
  }
  int bin_of(double value) const {
    const double bin = ((is_logarithmic ? std::log10(value) : value) - low) / width;
    return std::clamp(static_cast<int>(bin), 0, count - 1);
  }
};

using Values = std::vector<double> TreeDistributions::*;

struct Quantity {
  const char* name;
  const char* heading;
  const char* x_label;
  const char* unit;
  Values values;
  bool is_logarithmic;
};

constexpr Quantity kQuantities[] = {
    {"branching-angle", "Branching angles", "branching angle (degrees)", "degrees",
     &TreeDistributions::branching_angles_deg, false},
    {"axis-length", "Lengths of axes", "length of an axis (m)", "m", &TreeDistributions::axis_lengths, true},
    {"path-length", "Path lengths", "path from the root to a tip (m)", "m", &TreeDistributions::path_lengths,
     false},
};

std::vector<double> pooled(const Subject& subject, Values values) {
  std::vector<double> all;
  for (const Sample& sample : subject.samples) {
    const std::vector<double>& own = sample.distributions.*values;
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

/// Over what all subjects have; angles in steps of 7.5 degrees.
Bins bins_for(const Quantity& quantity, std::span<const std::vector<double>> values) {
  Bins bins;
  bins.is_logarithmic = quantity.is_logarithmic;
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const std::vector<double>& own : values) {
    for (const double value : own) {
      high = std::max(high, value);
      if (value > 0.0) low = std::min(low, value);
    }
  }
  if (quantity.values == &TreeDistributions::branching_angles_deg) {
    bins.width = 180.0 / kBins;
  } else if (quantity.is_logarithmic && low < high) {
    bins.low = std::log10(low);
    bins.width = (std::log10(high) - bins.low) / kBins;
  } else {
    bins.is_logarithmic = false;
    bins.width = high > 0.0 ? high / kBins : 1.0;
  }
  return bins;
}

Series histogram(const std::string& label, const std::vector<double>& values, const Bins& bins) {
  std::vector<double> counts(static_cast<std::size_t>(bins.count), 0.0);
  for (const double value : values) counts[static_cast<std::size_t>(bins.bin_of(value))] += 1.0;
  Series series;
  series.label = label;
  for (int bin = 0; bin < bins.count; ++bin) {
    series.x.push_back(bins.place(bin + 0.5));
    const double count = counts[static_cast<std::size_t>(bin)];
    series.y.push_back(values.empty() ? 0.0 : 100.0 * count / static_cast<double>(values.size()));
  }
  return series;
}

DistributionPlot histogram_plot(const Quantity& quantity, std::span<const Subject> subjects) {
  std::vector<std::vector<double>> values;
  for (const Subject& subject : subjects) values.push_back(pooled(subject, quantity.values));
  const Bins bins = bins_for(quantity, values);
  DistributionPlot result;
  result.heading = quantity.heading;
  result.plot.name = quantity.name;
  result.plot.x_label = quantity.x_label;
  result.plot.y_label = "share (%)";
  result.plot.style = PlotStyle::steps;
  result.plot.x_low = bins.place(0);
  result.plot.x_high = bins.place(bins.count);
  result.plot.is_x_logarithmic = bins.is_logarithmic;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    result.plot.series.push_back(histogram(subjects[i].label, values[i], bins));
    const auto median = quantile(values[i], 0.5);
    result.summaries.push_back(
        median ? fmt::format("median {:.3g} {} of {}", *median, quantity.unit, grouped(values[i].size()))
               : "none");
  }
  return result;
}

DistributionPlot width_plot(std::span<const Subject> subjects) {
  DistributionPlot result;
  result.heading = "Width by branch order";
  result.plot.name = "width-by-order";
  result.plot.x_label = "branch order";
  result.plot.y_label = "mean diameter at the base of axes (m)";
  result.plot.is_y_logarithmic = true;
  for (const Subject& subject : subjects) {
    std::vector<std::vector<double>> by_order;
    for (const Sample& sample : subject.samples) {
      const std::vector<double>& widths = sample.distributions.widths_by_order;
      if (by_order.size() < widths.size()) by_order.resize(widths.size());
      for (std::size_t order = 0; order < widths.size(); ++order) {
        if (widths[order] > 0.0) by_order[order].push_back(widths[order]);
      }
    }
    Series series;
    series.label = subject.label;
    for (std::size_t order = 0; order < by_order.size(); ++order) {
      if (by_order[order].empty()) continue;
      series.x.push_back(static_cast<double>(order));
      series.y.push_back(*mean(by_order[order]));
    }
    result.summaries.push_back(series.y.empty()
                                   ? "none"
                                   : fmt::format("from {:.3g} m at order 0 to {:.3g} m at order {}",
                                                 series.y.front(), series.y.back(), series.x.back()));
    result.plot.series.push_back(std::move(series));
  }
  return result;
}

}  // namespace

std::vector<DistributionPlot> distribution_plots(std::span<const Subject> subjects) {
  std::vector<DistributionPlot> plots;
  for (const Quantity& quantity : kQuantities) {
    const bool is_defined = std::any_of(subjects.begin(), subjects.end(), [&](const Subject& subject) {
      return !pooled(subject, quantity.values).empty();
    });
    if (is_defined) plots.push_back(histogram_plot(quantity, subjects));
  }
  plots.push_back(width_plot(subjects));
  return plots;
}

}  // namespace ramify::cli
