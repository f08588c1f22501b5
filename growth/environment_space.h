// Space as trees see it: marker points that nodes take away and buds grow towards. Palubicki et al. 2009,
// 4.1; Runions et al. 2007.
#pragma once

#include <vector>

#include "growth/growing_tree.h"
#include "growth/markers.h"

namespace ramify::growth {

/// The world's markers. The greatest r of its trees at any step is how far they will be seen.
Markers scattered_markers(const Parameters& world, const std::vector<TreePlace>& places);

/// A node of this tree made at this step takes the markers within rho.
double occupied_radius(const TreeParameters& tree, int step);

/// Working arrays of sense_space(), so that they need not be made anew in each step.
struct SpaceSearch {
  std::vector<Seeker> seekers;      // of all trees, tree by tree
  std::vector<std::uint32_t> buds;  // of each seeker, in its tree
  std::vector<std::size_t> ends;    // of each tree's seekers
  std::vector<Claim> claims;
};

/// Gives each marker to the nearest bud of any tree that sees it. Sets Q of each bud, 1 with a marker and 0
/// without, and V of those with a marker, towards their markers.
void sense_space(std::vector<GrowingTree>& trees, Markers& markers, int step, SpaceSearch& search);

}  // namespace ramify::growth
