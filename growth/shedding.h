// Where the plant sheds wood that costs more than it brings. Palubicki et al. 2009, 4.4.
#pragma once

#include <cstdint>
#include <vector>

#include "growth/light_sums.h"
#include "growth/plant.h"

namespace ramify::growth {

/// shed_by = light: the first nodes of the axes, never the trunk's, with less light an internode than the
/// threshold, judged all at once on the sums of this step. None up to step shed_after. After Takenaka 1994.
std::vector<std::uint32_t> shaded_axes(const Plant& plant, const LightSums& sums, const TreeParameters& tree,
                                       int step);

/// shed_by = vigour: the internodes that get less resource for each internode beyond them, their own
/// included, than the threshold; anywhere, on the trunk too. None up to step shed_after. SOT.
std::vector<std::uint32_t> starved_internodes(const Plant& plant, const LightSums& sums,
                                              const MappedVector<double>& vigour, const TreeParameters& tree,
                                              int step);

}  // namespace ramify::growth
