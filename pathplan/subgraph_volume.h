// The shapes of the graphs that are made around endpoints.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012, 3.3.2.
#pragma once

#include "common/volume/volume.h"
#include "pathplan/parameters.h"

namespace ramify::pathplan {

/// How far a graph of this level (2 or later) reaches from its root: r * a^(level - 2), metres.
double subgraph_radius(const Level& row, std::size_t level);

/// The volume in the graph's own frame: its root at the origin, its v_g along +Y. `radius` is its reach; a
/// custom volume is the row's own, scaled by it.
Volume subgraph_volume(const Level& row, double radius);

}  // namespace ramify::pathplan
