// The axes of a skeleton, each with its points in a row from base to tip: what goes along branches then reads
// memory in order. A skeleton's own order, that of growth, spreads an axis over all of it.
#pragma once

#include <cstdint>
#include <vector>

#include "common/base/bulk.h"
#include "common/base/geometry.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// A node as meshes need it. Like Axis without defaults: find_axes() writes all of them, and only once.
struct AxisPoint {
  Vec3f position;  // metres
  float radius;    // metres
  std::uint32_t node;
};

/// A run of Axes::points: the node that the first internode grows from, then the axis's own. A lateral is as
/// thick at its base as at its first node. One that leaves the last node of its bearer, about as thick, goes
/// on as a part of the bearer's run and has no points here.
struct Axis {
  std::uint32_t first;   // point
  std::uint32_t count;   // of points, at least 2; or 0
  std::uint32_t base;    // the bearer's point that the axis grows from; of a trunk its own first one
  std::uint32_t bearer;  // the axis that this one grows from; of a trunk kNoParent
  float bearer_radius;   // at the base; of a trunk its own
  float radius;          // at its first node

  bool is_trunk() const { return bearer == kNoParent; }
  std::uint32_t end() const { return first + count; }
};

struct Axes {
  BulkVector<Axis> list;  // by their first nodes: only a trunk may come after what grows beside it
  BulkVector<AxisPoint> points;
  BulkVector<std::uint8_t> marks;       // PointMark bits of each point, and kMarksBehind more
  std::vector<std::uint32_t> at_roots;  // the axes that grow from root nodes: trunks and real roots
  float thinnest = 0.0f;                // radius, metres: no point has less
  float thickest = 0.0f;                // radius of any node, metres
  float highest_ground = 0.0f;          // of the trees' roots, metres
};

/// All axes of a sound skeleton. O(n).
Axes find_axes(const Skeleton& skeleton);

}  // namespace ramify
