// Nodes on a cubic lattice, for comparison: its directions show in the branches.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012,
// Fig. 2.
#pragma once

#include "pathplan/domain.h"
#include "pathplan/poisson_disc.h"

namespace ramify::pathplan {

/// The points of a lattice with edges along the axes of the domain's frame that are in the domain; `root`
/// (first) is one of them. Without a given spacing its edge is (V/K)^(1/3), so there are about K nodes.
/// O(cells of the domain's box).
Nodes lattice_nodes(const Domain& domain, const Vec3& root, const Scatter& scatter, double cubic_metres);

}  // namespace ramify::pathplan
