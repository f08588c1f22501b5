#include "cli/experiment/sweep_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>

#include "common/analysis/metrics.h"
#include "common/analysis/statistics.h"

namespace ramify::cli {
namespace {

// Of the metrics, those that say most; results.csv has all.
constexpr std::array kMetrics = {
    "internodes",           "height",          "crown_radius",  "crown_volume",
    "trunk_diameter",       "total_length",    "wood_volume",   "bifurcation_ratio",
    "branching_angle_mean", "tortuosity_mean", "path_fraction", "fractal_dimension"};

constexpr const char* kSeconds = "seconds";
constexpr const char* kMemory = "peak_memory";

std::optional<double> number_of(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The values of the k-th key, in the order in which they come first.
std::vector<std::string> values_of(const Responses& responses, std::size_t k) {
  std::vector<std::string> values;
  for (const auto& point : responses.points) {
    if (std::find(values.begin(), values.end(), point[k]) == values.end()) values.push_back(point[k]);
  }
  return values;
}

std::size_t place_of(const std::vector<std::string>& values, const std::string& value) {
  return static_cast<std::size_t>(std::find(values.begin(), values.end(), value) - values.begin());
}

/// The numbers that a key's values are; none if one of them is no number.
std::vector<double> numbers_of(const std::vector<std::string>& values) {
  std::vector<double> numbers;
  for (const std::string& value : values) {
    const auto number = number_of(value);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

/// Whether a figure would show anything: two values that differ.
bool varies(const Response& response) {
  std::vector<double> values;
  for (const auto& value : response.mean) {
    if (value) values.push_back(*value);
  }
  if (values.empty()) return false;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low > 1e-9 * std::max(std::abs(*low), std::abs(*high));
}

Response response_of(const Quantity& quantity, const SweepResults& results,
                     const std::vector<std::vector<std::size_t>>& runs) {
  Response response{quantity, {}, {}};
  for (const std::vector<std::size_t>& own : runs) {
    std::vector<double> values;
    for (const std::size_t run : own) {
      if (const auto value = value_of(results.rows[run], quantity)) values.push_back(*value);
    }
    response.mean.push_back(mean(values));
    response.deviation.push_back(standard_deviation(values));
  }
  return response;
}

std::string name_of(const Quantity& quantity) {
  std::string name = quantity.key;
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

}  // namespace

std::string label_of(const Quantity& quantity) {
  std::string words = quantity.key;
  std::replace(words.begin(), words.end(), '_', ' ');
  return quantity.unit.empty() ? words : fmt::format("{} ({})", words, quantity.unit);
}

std::vector<Quantity> shown_quantities() {
  std::vector<Quantity> quantities;
  for (const MetricInfo& info : metric_table()) {
    if (std::find(kMetrics.begin(), kMetrics.end(), info.key) == kMetrics.end()) continue;
    quantities.push_back({std::string(info.key), std::string(info.unit)});
  }
  quantities.push_back({kSeconds, "s"});
  quantities.push_back({kMemory, "MB"});
  return quantities;
}

std::optional<double> value_of(const SweepRow& row, const Quantity& quantity) {
  if (!row.record) return std::nullopt;
  if (quantity.key == kSeconds) return row.record->seconds;
  if (quantity.key == kMemory) return static_cast<double>(row.record->peak_memory_bytes) / 1e6;
  return metric_of(*row.record, quantity.key);
}

Responses responses_of(const SweepResults& results) {
  const std::vector<std::string>& all = results.plan.keys;
  Responses responses;
  std::vector<std::size_t> kept;  // places of the keys
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k] == "seed" && all.size() > 1) continue;
    kept.push_back(k);
    responses.keys.push_back(all[k]);
  }
  std::map<std::vector<std::string>, std::size_t> places;
  std::vector<std::vector<std::size_t>> runs;  // by point
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    std::vector<std::string> point;
    for (const std::size_t k : kept) point.push_back(results.plan.runs[i].values[k]);
    const auto [found, is_new] = places.emplace(point, runs.size());
    if (is_new) {
      responses.points.push_back(point);
      runs.emplace_back();
    }
    runs[found->second].push_back(i);
  }
  for (const auto& own : runs) responses.seeds = std::max(responses.seeds, own.size());
  for (const Quantity& quantity : shown_quantities()) {
    Response response = response_of(quantity, results, runs);
    if (varies(response)) responses.responses.push_back(std::move(response));
  }
  return responses;
}

std::vector<Plot> lines_of(const Responses& responses) {
  if (responses.keys.size() != 1) return {};
  const std::vector<std::string> values = values_of(responses, 0);
  const std::vector<double> numbers = numbers_of(values);
  std::vector<Plot> plots;
  for (const Response& response : responses.responses) {
    Plot plot;
    plot.name = name_of(response.quantity);
    plot.x_label = responses.keys[0];
    plot.y_label = label_of(response.quantity);
    if (numbers.empty()) plot.x_names = values;
    Series series;
    std::vector<std::pair<double, std::size_t>> order;  // a line goes from left to right
    for (std::size_t i = 0; i < values.size(); ++i) {
      order.emplace_back(numbers.empty() ? static_cast<double>(i) : numbers[i], i);
    }
    std::sort(order.begin(), order.end());
    for (const auto& [x, i] : order) {
      if (!response.mean[i]) continue;
      series.x.push_back(x);
      series.y.push_back(*response.mean[i]);
      if (responses.seeds > 1) series.deviation.push_back(response.deviation[i].value_or(0.0));
    }
    plot.series.push_back(std::move(series));
    plots.push_back(std::move(plot));
  }
  return plots;
}

std::vector<HeatMap> maps_of(const Responses& responses) {
  if (responses.keys.size() != 2) return {};
  const std::vector<std::string> rows = values_of(responses, 0);
  const std::vector<std::string> columns = values_of(responses, 1);
  std::vector<HeatMap> maps;
  for (const Response& response : responses.responses) {
    HeatMap map;
    map.name = name_of(response.quantity);
    map.label = label_of(response.quantity);
    map.x_label = responses.keys[1];
    map.y_label = responses.keys[0];
    map.x_names = columns;
    map.y_names = rows;
    map.values.resize(rows.size() * columns.size());
    for (std::size_t i = 0; i < responses.points.size(); ++i) {
      const std::vector<std::string>& point = responses.points[i];
      map.values[place_of(rows, point[0]) * columns.size() + place_of(columns, point[1])] = response.mean[i];
    }
    maps.push_back(std::move(map));
  }
  return maps;
}

}  // namespace ramify::cli
