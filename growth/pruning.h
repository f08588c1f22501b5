// Shears: wood cut to a shape from outside.
#pragma once

#include <cstdint>
#include <vector>

#include "growth/plant.h"

namespace ramify::growth {

/// Whether this event is due after `step`.
bool is_due(const PruneEvent& event, int step);

/// The internodes whose upper ends lie on the side that the event cuts.
std::vector<std::uint32_t> pruned_internodes(const Plant& plant, const PruneEvent& event);

}  // namespace ramify::growth
