// The trees in numbers: their metrics beside each other, and how angles and lengths are spread.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/analysis/distances.h"
#include "common/analysis/metrics.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// How many axes of each order fall into each class, from `low` to `high` in even steps.
struct Histogram {
  static constexpr std::size_t kClasses = 18;
  double low = 0.0;
  double high = 1.0;
  std::vector<std::array<float, kClasses>> by_order;  // the last one holds that order and all above
};

struct Numbers {
  Metrics metrics;
  TreeForm form;      // what the distances between trees compare
  Histogram angles;   // of branching, degrees
  Histogram lengths;  // of axes, metres
};

/// In no more than seven characters: "0.0842", "18357", "2.54e6", "-3.1e-4"; of numbers above 0 with their
/// sign, if it is asked for. Counts have no decimals.
std::string number_text(double value, bool is_count, bool with_sign = false);

/// Measures a tree. The skeleton must be sound. O(n log n).
Numbers numbers_of(const Skeleton& skeleton);

}  // namespace ramify
