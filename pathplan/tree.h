// From paths to a tree: their union, with widths.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012, 3.2.
#pragma once

#include <cstdint>
#include <span>

#include "common/skeleton/skeleton.h"
#include "pathplan/graph.h"
#include "pathplan/shortest_paths.h"

namespace ramify::pathplan {

/// A node's width is s^zeta, s being the greatest length walked to it from an endpoint, scaled so that the
/// root's is trunk_diameter.
struct Taper {
  double zeta = 0.3;
  double trunk_diameter = 0.4;  // metres
  double tip_diameter = 0.01;   // metres, the least anywhere
};

/// The union of the paths from the endpoints to the root, node 0, as a skeleton with axes and orders; nodes
/// by rising cost. Endpoints must be reached. O(n log n) in its nodes.
Skeleton make_tree(const Graph& graph, const ShortestPaths& paths, std::span<const std::uint32_t> endpoints,
                   const Taper& taper);

/// The tree before anything is planned: a root node without internodes.
Skeleton bare_root(const Vec3& position, const Taper& taper);

}  // namespace ramify::pathplan
