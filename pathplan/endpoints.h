// Which nodes paths are planned to.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012, 3.3.1;
// in stages: L. Xu and D. Mould, Procedural tree modeling with guiding vectors, CGF 34(7), 2015.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "common/base/geometry.h"
#include "common/volume/solid.h"
#include "pathplan/graph.h"
#include "pathplan/parameters.h"
#include "pathplan/path_union.h"

namespace ramify::pathplan {

/// What endpoints are chosen from: the nodes of one graph, node 0 being its root, which is never one.
struct Candidates {
  std::span<const Vec3> nodes;
  const Solid* region = nullptr;                   // kinds shell and region; none: everywhere
  std::span<const std::uint32_t> subvolumes = {};  // of each node; none: the graph is of one piece
  std::function<bool(std::uint32_t)> is_fit = {};  // which nodes come into question; none: all
};

/// What is wanted of them.
struct EndpointWish {
  EndpointKind kind = EndpointKind::random;
  int b = 1;                                 // in all; not of kind manual
  double shell_thickness = 0.5;              // metres
  std::span<const ManualPoint> points = {};  // in the graph's frame
  bool must_be_all = true;                   // else fewer where there are no more
  std::uint64_t seed = 1;
};

/// b distinct nodes of those that the kind allows, each set of them equally likely. Where nodes have
/// subvolumes (0 is the trunk and gets none) each of the others gets the same number, the first ones more by
/// one where that does not come out even. Manual ones are the nodes nearest to the points, each once. Throws
/// RunError if there are fewer than must be, or if a point's nearest node is the root. O(nodes).
std::vector<std::uint32_t> choose_endpoints(const Candidates& candidates, const EndpointWish& wish);

/// Nodes that are not in the union but at most stage.hops edges away from it: stage.b of them, as above.
/// `number` (from 1) is that of the stage. O(nodes + edges within reach).
std::vector<std::uint32_t> choose_nearby_endpoints(const Graph& graph, const PathUnion& paths,
                                                   const Stage& stage, std::size_t number, bool must_be_all,
                                                   std::uint64_t seed);

}  // namespace ramify::pathplan
