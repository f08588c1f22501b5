// v_g: where the graph around an endpoint is turned to.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012, Fig. 4
// (step 4B), 3.3.2 and 3.4. (3.3.2 words v_g the other way round; Fig. 4's e - R is what the pictures show.)
#pragma once

#include "common/base/geometry.h"
#include "common/base/rng.h"
#include "pathplan/parameters.h"

namespace ramify::pathplan {

/// Unit vector. `outwards` (unit) leads from the root of the endpoint's own graph to the endpoint. The row's
/// choice is turned up or down, then drawn to the light. Random numbers are drawn where they are needed: for
/// v_g random, and to turn away from the vertical.
Vec3 subgraph_direction(const Level& row, const Light& light, const Vec3& outwards, Rng& rng);

}  // namespace ramify::pathplan
