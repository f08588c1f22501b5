// Shedding of branches that live in the shade. Palubicki et al. 2009, 4.4, after Takenaka 1994.
#pragma once

#include <cstdint>
#include <vector>

#include "growth/plant.h"
#include "growth/shadow_grid.h"

namespace ramify::growth {

/// The axes, never the trunk, with less light an internode than the threshold, judged all at once on the sums
/// of this step. None up to step shed_after.
std::vector<std::uint32_t> shaded_axes(const Plant& plant, const LightSums& sums,
                                       const Parameters& parameters, int step);

/// Sheds these axes whole, with the axes on them: their internodes leave the tree, their buds die, and their
/// shadows are to be taken from the returned voxels. O(nodes) if there is anything to shed.
std::vector<Coord> shed_axes(Plant& plant, const std::vector<std::uint32_t>& axes,
                             const Parameters& parameters, const ShadowGrid& shadow, int step);

}  // namespace ramify::growth
