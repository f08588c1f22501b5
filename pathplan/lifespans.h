// How many levels may follow an endpoint, and how many endpoints its graph gets.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012, 3.2,
// 3.3.3 and 3.4.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/geometry.h"
#include "pathplan/parameters.h"

namespace ramify::pathplan {

/// An endpoint of one level, before its own graph is made.
struct Sprout {
  Vec3 v_g{0.0, 1.0, 0.0};  // of its graph, unit
  int lifespan = 0;         // before: of the endpoint that its own graph was made around; after: its own
  double b_factor = 1.0;    // of the endpoints of its graph, set by the light
};

/// Sets the lifespans, and the endpoint counts that the light gives, of all endpoints of a level. A decrement
/// is 1; or drawn (distribution; not at level 1, whose branches all start alike); or dealt out by the light:
/// as many numbers as there are endpoints are drawn and sorted, and the endpoint whose v_g is nearest to the
/// light gets the least decrement and the greatest count. O(n log n).
void deal_lifespans(const Lifespan& lifespan, const Light& light, std::size_t level, std::uint64_t seed,
                    std::span<Sprout> sprouts);

}  // namespace ramify::pathplan
