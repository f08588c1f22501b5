// Which nodes paths are planned to.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012, 3.3.1.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/geometry.h"
#include "pathplan/parameters.h"

namespace ramify::pathplan {

/// level.b distinct nodes of those that level.endpoints allows, each set of them equally likely; never node
/// 0, the root. Throws RunError if there are fewer. O(nodes).
std::vector<std::uint32_t> choose_endpoints(std::span<const Vec3> nodes, const Level& level,
                                            std::uint64_t seed);

}  // namespace ramify::pathplan
