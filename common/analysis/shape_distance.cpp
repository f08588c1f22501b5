#include <cmath>

#include "common/analysis/distances.h"

namespace ramify {

double shape_distance(const TreeForm& a, const TreeForm& b) {
  constexpr double kSigma = 0.25;  // in units of the mean of both values
  double sum = 0.0;
  for (std::size_t i = 0; i < kShapeFeatures; ++i) {
    const double center = 0.5 * (a.shape[i] + b.shape[i]);
    if (center == 0.0) continue;
    const double difference = (a.shape[i] - b.shape[i]) / center;
    sum += 1.0 - std::exp(-difference * difference / (2.0 * kSigma * kSigma));
  }
  return sum / static_cast<double>(kShapeFeatures);
}

}  // namespace ramify
