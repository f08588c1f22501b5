// What a mesh of tubes is made of, before anything of it is written: which points of the axes are kept, how
// many sides and rings each tube has and where it goes in the mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "common/base/bulk.h"
#include "common/mesh/axes.h"
#include "common/mesh/centre_line.h"
#include "common/mesh/collar.h"
#include "common/mesh/mesher.h"
#include "common/mesh/point_marks.h"
#include "common/mesh/root_flare.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

// The part of a lateral's first stretch that its first bend may count on: the collar takes the rest.
constexpr float kRoomBesideCollar = 0.5f;

// Of the thickest wood: thinner twigs, which have three sides, just begin inside their parents. They are most
// of a tree, and a collar takes as long as the rest of a twig.
constexpr float kLeastCollar = 0.03f;

// Cosine beyond which a line turns back on itself, and frames are carried on as they are.
constexpr float kHalfTurn = -0.9999f;

/// The tube of an axis. Like Axis without defaults: plan_tubes() writes all of them, and only once.
struct Tube {
  std::uint32_t rings;  // of vertices, the collar's among them; without rings it is left out
  std::uint16_t sides;
  std::uint8_t collar;       // stretches that the collar's curve is parted into; 0: no collar
  std::uint8_t flare_rings;  // of twice as many sides
  bool is_closed;            // a trunk: its base is seen
  bool has_flare;
  bool is_pointed;  // ends in a point at its last node; else in a tip beyond it
  bool is_plain;    // see PlainTubeWriter
  bool is_low;      // reaches down to the ground
  bool tapers;      // much, on some stretch: that has rings of its own
  std::size_t first_vertex;
  std::size_t first_triangle;

  bool has_round_tip() const { return !is_pointed && sides > 3; }
  friend bool operator==(const Tube&, const Tube&) = default;
};

struct TubePlan {
  const Axes* axes = nullptr;
  CentreLine line = CentreLine::polyline;
  double flare = 0.0;
  double tolerance = 0.0;          // metres
  BulkVector<std::uint8_t> rings;  // of each point on its axis' line; 0: left out, but for its first
  BulkVector<Tube> tubes;          // of each axis
  std::size_t vertex_count = 0;
  std::size_t triangle_count = 0;
};

/// With a tolerance, metres, axes whose subtrees reach no farther are left out, lines are straightened by no
/// more than half of it and tubes have fewer sides; collars, arcs and the flare go where they are of its
/// size. Without one nothing goes but nodes that crowd. O(n), on all threads. The axes are the skeleton's and
/// must outlive the plan.
TubePlan plan_tubes(const Skeleton& skeleton, const Axes& axes, const MesherOptions& options,
                    double tolerance = 0.0);

/// The knots of a tube that is not left out, measured; a lateral's begin at its bearer's point.
void collect_knots(const TubePlan& plan, std::size_t tube, std::vector<Knot>& knots);

/// A tube's triangles in the mesh but for its closed base's, from its base to its tip: the first one and the
/// one behind the last.
std::pair<std::size_t, std::size_t> triangles_around(const TubePlan& plan, std::size_t tube);

/// The bearer's wood where a lateral leaves it.
Fork fork_at(const TubePlan& plan, std::size_t tube);

/// The points of a tube's line, and the flare at its foot.
RootFlare trace_tube(const TubePlan& plan, const Tube& tube, const std::vector<Knot>& knots,
                     std::vector<LinePoint>& points);

}  // namespace ramify
