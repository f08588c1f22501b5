#include "viewer/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/analysis/anatomy.h"
#include "common/analysis/measures.h"

namespace ramify {
namespace {

// Orders from this one on are counted together: there are colours to tell so many apart.
constexpr std::size_t kOrders = 5;

/// `values` has one entry an axis.
Histogram histogram(const Anatomy& tree, const std::vector<std::optional<double>>& values, double high) {
  Histogram result;
  result.high = high;
  for (std::size_t axis = 0; axis < values.size(); ++axis) {
    if (!values[axis]) continue;
    const std::size_t order = std::min<std::size_t>(tree.axis_order(axis), kOrders - 1);
    if (result.by_order.size() <= order) result.by_order.resize(order + 1, {});
    const double part = *values[axis] / high * Histogram::kClasses;
    const auto last = static_cast<double>(Histogram::kClasses - 1);
    result.by_order[order][static_cast<std::size_t>(std::clamp(part, 0.0, last))] += 1.0f;
  }
  return result;
}

}  // namespace

std::string number_text(double value, bool is_count, bool with_sign) {
  if (value == 0.0) return "0";
  const std::string sign = value < 0.0 ? "-" : with_sign ? "+" : "";
  const double size = std::abs(value);
  // Bounds just below powers of ten: no rounding adds a digit.
  if (size >= 0.00095 && size < 999'999.5) {
    const int before = size < 9.9995 ? 1 : size < 99.995 ? 2 : size < 999.95 ? 3 : 4;
    const bool is_whole = is_count || before == 4;
    return sign + fmt::format("{:.{}f}", size, is_whole ? 0 : size < 0.99995 ? 4 : 4 - before);
  }
  const std::string text = fmt::format("{:.{}e}", size, size < 1.0 ? 1 : 2);
  const std::size_t exponent = text.find('e');
  return sign + text.substr(0, exponent + 1) + std::to_string(std::stoi(text.substr(exponent + 1)));
}

Numbers numbers_of(const Skeleton& skeleton) {
  Numbers numbers;
  numbers.metrics = measure(skeleton);
  numbers.form = form_of(skeleton);
  const Anatomy tree(skeleton);
  numbers.angles = histogram(tree, branching_angles_deg(tree), 180.0);
  std::vector<std::optional<double>> lengths;
  double longest = 0.0;
  for (std::size_t axis = 0; axis < tree.axis_count(); ++axis) {
    double length = 0.0;
    for (const std::uint32_t node : tree.axis(axis)) length += skeleton.length(node);
    lengths.emplace_back(length);
    longest = std::max(longest, length);
  }
  numbers.lengths = histogram(tree, lengths, std::max(longest, 1e-9));
  return numbers;
}

}  // namespace ramify
