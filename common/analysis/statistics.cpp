#include "common/analysis/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ramify {

std::optional<double> mean(std::span<const double> sample) {
  if (sample.empty()) return std::nullopt;
  return std::accumulate(sample.begin(), sample.end(), 0.0) / static_cast<double>(sample.size());
}

std::optional<double> standard_deviation(std::span<const double> sample) {
  if (sample.size() < 2) return std::nullopt;
  const double center = *mean(sample);
  double sum = 0.0;
  for (const double x : sample) sum += (x - center) * (x - center);
  return std::sqrt(sum / static_cast<double>(sample.size() - 1));
}

std::optional<double> quantile(std::vector<double> sample, double fraction) {
  if (sample.empty()) return std::nullopt;
  const double place = fraction * static_cast<double>(sample.size() - 1);
  const auto below = sample.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(sample.begin(), below, sample.end());
  const double part = place - std::floor(place);
  if (part == 0.0) return *below;
  return *below + part * (*std::min_element(below + 1, sample.end()) - *below);
}

std::optional<double> regression_slope(std::span<const double> x, std::span<const double> y) {
  const std::optional<double> x_mean = mean(x);
  if (!x_mean) return std::nullopt;
  const double y_mean = *mean(y);
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    products += (x[i] - *x_mean) * (y[i] - y_mean);
    squares += (x[i] - *x_mean) * (x[i] - *x_mean);
  }
  if (squares == 0.0) return std::nullopt;
  return products / squares;
}

}  // namespace ramify
