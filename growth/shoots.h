// Shoots: what buds with enough resource grow in a step. Palubicki et al. 2009, 4.3.
#pragma once

#include <vector>

#include "growth/plant.h"
#include "growth/shadow_grid.h"

namespace ramify::growth {

/// Voxels in which something begins or ceases to cast shadow.
struct CasterChanges {
  std::vector<Coord> added;
  std::vector<Coord> removed;
};

/// How many metamers the buds will make with this vigour; a number that may be beyond all memory.
double planned_metamers(const std::vector<double>& vigour, const Parameters& parameters, int step);

/// Grows a shoot from each bud with v >= 1, all in the light as it stands in `shadow`. The trunk's base must
/// not be below ground. O(metamers made), on all threads.
CasterChanges extend_shoots(Plant& plant, const std::vector<double>& vigour, const Parameters& parameters,
                            const ShadowGrid& shadow, int step);

}  // namespace ramify::growth
