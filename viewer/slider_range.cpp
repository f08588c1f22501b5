#include "viewer/slider_range.h"

#include <algorithm>
#include <cmath>

namespace ramify {
namespace {

// Ranges no wider than this are handy: degrees all round, shares, weights of a few.
constexpr double kHandySpan = 360.0;
constexpr double kHandyRatio = 20.0;  // of the range to the value

constexpr double kReach = 4.0;  // of other sliders, in values

/// The least of 1, 2, 5 times a power of ten that is not below `value` (> 0).
double round_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (value <= step * power * (1.0 + 1e-9)) return step * power;
  }
  return 10.0 * power;
}

}  // namespace

SliderRange slider_range(const FieldInfo& info, double value, double reference) {
  const double greatest = std::max(std::abs(value), std::abs(reference));
  const double span = info.max - info.min;
  const bool is_handy = info.unit == "degrees" || span <= 1.0 ||
                        (span <= kHandySpan && span <= kHandyRatio * std::abs(reference));
  SliderRange range{info.min, info.max};
  if (!is_handy) {
    const double reach = round_up(kReach * (reference != 0.0 ? std::abs(reference) : 0.25));
    const double most = std::max(reach, greatest);
    range = {std::max(info.min, -most), std::min(info.max, most)};
  }
  if (info.is_above_min && range.low == info.min) range.low += 1e-3 * (range.high - range.low);
  return range;
}

}  // namespace ramify
