// One of the trees that grow together: its plant, and what its buds get in a step.
#pragma once

#include <optional>
#include <vector>

#include "growth/history.h"
#include "growth/light_sums.h"
#include "growth/plant.h"

namespace ramify::growth {

struct GrowingTree {
  TreePlace place;
  Plant plant;
  std::optional<History> history;

  // As last sensed, one entry a bud
  MappedVector<double> light;   // Q
  MappedVector<double> vigour;  // v
  MappedVector<Vec3f> space;    // V where Q > 0; with environment = space only

  LightSums sums;                     // as allocation leaves them
  double resource = 0.0;              // v at the root
  std::vector<std::uint32_t> shaded;  // the nodes that are shed for want of light in this step
};

}  // namespace ramify::growth
