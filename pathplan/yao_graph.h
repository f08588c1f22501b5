// Yao graph: for each node and sector, an edge to the nearest node in that sector.
// A. C. Yao, On constructing minimum spanning trees in k-dimensional spaces, SIAM J. Comput. 11(4), 1982.
// With octants it is the Orthant Neighborhood Graph: T. Germer and T. Strothotte, GRAPP 2007.
#pragma once

#include <span>
#include <stop_token>
#include <vector>

#include "pathplan/edge_rules.h"
#include "pathplan/graph.h"

namespace ramify::pathplan {

/// Undirected edges, each once, from each node to the nearest one in each sector that the rules allow and
/// that is no farther than they say; equal distances, to a part in 10^13: the lower number.
/// `sectors`: 8, octants by the signs of the difference, 0 counting as +; 6, cones over the faces of a cube,
/// by the coordinate that is largest in magnitude (the first of equal ones) and its sign; or 14, to the faces
/// and corners of a cube, whichever is nearest by angle (a face rather than a corner).
/// `spacing` (metres) is about the distance of neighbours and bears on the speed alone.
/// O(nodes) on all threads; a stop request leaves edges out.
std::vector<Edge> yao_edges(std::span<const Vec3> nodes, const EdgeRules& rules, int sectors, double spacing,
                            std::stop_token stop = {});

}  // namespace ramify::pathplan
