// Threshold graph: an edge between any two nodes that are near enough.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012, 3.1.
#pragma once

#include <span>
#include <stop_token>
#include <vector>

#include "pathplan/edge_rules.h"
#include "pathplan/graph.h"

namespace ramify::pathplan {

/// Undirected edges, each once, between all nodes that are no farther apart than the rules say and that they
/// allow. O(nodes + pairs within reach) on all threads; a stop request leaves edges out.
std::vector<Edge> threshold_edges(std::span<const Vec3> nodes, const EdgeRules& rules,
                                  std::stop_token stop = {});

}  // namespace ramify::pathplan
