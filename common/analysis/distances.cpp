#include "common/analysis/distances.h"

namespace ramify {
namespace {

constexpr std::array<DistanceInfo, kDistanceCount> kDistances = {{
    {"scatter", "Angles, sizes and places of branches and segments (Potapov et al. 2017)", &scatter_distance},
    {"morphology", "Lengths of branches along the paths from the root (Kanari et al. 2018)",
     &morphology_distance},
    {"shape", "Height, crown radius and where the tips are (Stava et al. 2014)", &shape_distance},
}};

}  // namespace

std::span<const DistanceInfo, kDistanceCount> distance_table() {
  return kDistances;
}

std::array<double, kDistanceCount> distances_of(const TreeForm& a, const TreeForm& b) {
  std::array<double, kDistanceCount> values{};
  for (std::size_t k = 0; k < kDistanceCount; ++k) values[k] = kDistances[k].value(a, b);
  return values;
}

}  // namespace ramify
