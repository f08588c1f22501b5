// What a sweep shows over the keys that it varies: lines over one, heat maps over two.
#pragma once

#include <string>
#include <vector>

#include "cli/experiment/plots.h"
#include "cli/experiment/sweep_results.h"

namespace ramify::cli {

/// A quantity of the runs: a metric, seconds or peak memory.
struct Quantity {
  std::string key;
  std::string unit;  // empty for pure numbers
};

/// A quantity over the values of the keys; seeds are taken together where another key varies, too.
struct Response {
  Quantity quantity;
  std::vector<std::optional<double>> mean;       // a point each; nothing where no run has a value
  std::vector<std::optional<double>> deviation;  // between seeds; needs two
};

/// The runs of a sweep by the keys that figures are drawn over.
struct Responses {
  std::vector<std::string> keys;
  std::vector<std::vector<std::string>> points;  // values of the keys
  std::size_t seeds = 1;                         // most runs of one point
  std::vector<Response> responses;               // of the quantities that are worth a figure
};

Responses responses_of(const SweepResults& results);

/// A line each where one key varies; else none.
std::vector<Plot> lines_of(const Responses& responses);

/// A map each where two keys vary; else none.
std::vector<HeatMap> maps_of(const Responses& responses);

/// "height (m)".
std::string label_of(const Quantity& quantity);

/// The value of a quantity of the figures; nothing where the run has none.
std::vector<Quantity> shown_quantities();
std::optional<double> value_of(const SweepRow& row, const Quantity& quantity);

}  // namespace ramify::cli
