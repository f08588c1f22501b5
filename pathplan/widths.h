// How thick planned branches are.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012, 3.2.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/skeleton/skeleton.h"

namespace ramify::pathplan {

/// The endpoints of one level and its taper.
struct TaperedTips {
  std::vector<std::uint32_t> nodes;
  double zeta = 0.3;
};

/// A node's width is the greatest s^zeta over the endpoints above it, s being the length walked from there in
/// units of `edge_length` metres (the mean edge of level 1: else zeta would depend on the unit). Scaled so
/// that the root's is `trunk_diameter`; `tip_diameter` is the least anywhere, metres. O(nodes * levels).
void assign_tapered_widths(Skeleton& tree, std::span<const TaperedTips> levels, double edge_length,
                           double trunk_diameter, double tip_diameter);

/// The pipe model instead: d^exponent = sum of the children's, scaled and bounded in the same way. O(nodes).
void assign_piped_widths(Skeleton& tree, double exponent, double trunk_diameter, double tip_diameter);

}  // namespace ramify::pathplan
