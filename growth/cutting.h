// Wood that leaves the plant: where it is cut is said by shedding.h and pruning.h.
#pragma once

#include <cstdint>
#include <vector>

#include "growth/plant.h"

namespace ramify::growth {

/// The nodes `cuts` and all that grow from them, ascending. O(nodes).
std::vector<std::uint32_t> nodes_beyond(const Plant& plant, const std::vector<std::uint32_t>& cuts);

/// Adds to nodes that go, ascending, all that has grown from them since there were `first` nodes. O(nodes
/// given and grown).
void follow_growth(const Plant& plant, std::size_t first, std::vector<std::uint32_t>& nodes);

/// Takes these nodes, with which all beyond them must go, out of the plant; the wood below stays as thick as
/// it was. Buds that stood on them are left to the caller: plant.is_cut(bud.node). O(nodes given).
void cut_away(Plant& plant, const std::vector<std::uint32_t>& nodes);

}  // namespace ramify::growth
