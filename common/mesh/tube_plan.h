// What a mesh of tubes is made of, before anything of it is written: the axes of a skeleton, which of their
// nodes are kept, how many sides and rings each tube has and where it goes in the mesh.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "common/mesh/centre_line.h"
#include "common/mesh/collar.h"
#include "common/mesh/mesher.h"
#include "common/mesh/root_flare.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

// The part of a lateral's first stretch that its first bend may count on: the collar takes the rest.
constexpr double kRoomBesideCollar = 0.5;

/// An axis: its nodes follow from `first` by TubePlan::continuation. Without rings it is left out.
struct Tube {
  std::uint32_t base = 0;  // the node that its first internode grows from
  std::uint32_t first = 0;
  std::uint32_t parent = kNoParent;  // the tube that bears it; none for a trunk
  std::uint32_t rings = 0;           // of vertices, the collar's among them
  std::uint16_t sides = 0;
  std::uint8_t collar = 0;  // stretches that the collar's curve is parted into; 0: no collar
  bool is_closed = false;   // begins at a root node: its base is seen
  bool has_flare = false;
  bool is_pointed = false;        // ends in a point at its last node; else in a tip beyond it
  std::uint32_t flare_rings = 0;  // of twice as many sides
  std::size_t first_vertex = 0;
  std::size_t first_triangle = 0;

  bool has_round_tip() const { return !is_pointed && sides >= 6; }
};

struct TubePlan {
  const Skeleton* skeleton = nullptr;
  CentreLine line = CentreLine::polyline;
  double flare = 0.0;
  double tolerance = 0.0;                   // metres
  double thinnest = 0.0;                    // radius, metres
  std::vector<std::uint32_t> continuation;  // of a node: the next of its axis, or kNoParent
  std::vector<std::uint8_t> rings;          // of a node on its own tube; 0: left out
  std::vector<Tube> tubes;
  std::size_t vertex_count = 0;
  std::size_t triangle_count = 0;

  double radius(std::size_t node) const { return std::max(0.5 * skeleton->diameter[node], thinnest); }
};

/// With a tolerance, metres, axes whose subtrees reach no farther are left out, lines are straightened by no
/// more than half of it and tubes have fewer sides; collars, arcs and the flare go where they are of its
/// size. Without one nothing goes but nodes that crowd. O(n), on all threads.
TubePlan plan_tubes(const Skeleton& skeleton, const MesherOptions& options, double tolerance = 0.0);

/// The knots of a tube that is not left out, measured; a lateral's begin at its parent's node.
void collect_knots(const TubePlan& plan, const Tube& tube, std::vector<Knot>& knots);

/// The parent's wood where a lateral leaves it.
Fork fork_at(const TubePlan& plan, const Tube& lateral);

/// The points of a tube's line, and the flare at its foot.
RootFlare trace_tube(const TubePlan& plan, const Tube& tube, const std::vector<Knot>& knots,
                     std::vector<LinePoint>& points);

}  // namespace ramify
