// Comparison of real numbers, the same for either Catch2.
#pragma once

#include <algorithm>
#include <cmath>

namespace ramify::test {

inline bool is_close(double a, double b, double tolerance = 1e-6) {
  return std::abs(a - b) <= tolerance * std::max({1e-3, std::abs(a), std::abs(b)});
}

}  // namespace ramify::test
