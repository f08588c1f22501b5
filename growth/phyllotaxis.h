// Where the axillary bud of a node points.
#pragma once

#include "growth/plant.h"

namespace ramify::growth {

/// The default direction of the bud on the rank-th node of axis number `axis_index`, `axis` being as it is at
/// that node. The same for the same seed, axis and rank.
Vec3 axillary_direction(const Parameters& parameters, const Axis& axis, std::uint32_t axis_index,
                        std::uint32_t rank, int step);

}  // namespace ramify::growth
