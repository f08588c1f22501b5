// Small statistics; absence where a sample does not define the value.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace ramify {

/// Nothing for an empty sample.
std::optional<double> mean(std::span<const double> sample);

/// Standard deviation of the population that the sample is drawn from (n - 1); nothing below two values.
std::optional<double> standard_deviation(std::span<const double> sample);

/// The value that a `fraction` (0 to 1) of the sample lies below, linear between the two nearest values.
/// Nothing for an empty sample. O(n).
std::optional<double> quantile(std::vector<double> sample, double fraction);

/// Slope of the least-squares line of y on x; nothing if the x are fewer than two different ones.
std::optional<double> regression_slope(std::span<const double> x, std::span<const double> y);

}  // namespace ramify
