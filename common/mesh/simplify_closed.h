// Fewer triangles where a closed surface is nearly flat: half-edge collapses that keep it a closed manifold.
// H. Hoppe et al., Mesh optimization, SIGGRAPH 1993: an edge may go if its ends have two neighbours in
// common.
#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/mesh.h"

namespace ramify {

/// What may become of a vertex.
struct Freedom {
  bool can_go = true;       // else it stays
  bool is_whole = true;     // all triangles around it are at hand; else it stays, and no other goes there
  bool is_settled = false;  // it found no way to go, and nothing around it has changed since
};

/// A closed surface or a part of one. Arrays have one entry a vertex.
struct CollapsibleMesh {
  BulkVector<Vec3f> positions;
  BulkVector<Vec3f> normals;
  std::vector<float> errors;  // metres that the surface around it has moved
  std::vector<Freedom> freedom;
  BulkVector<Triangle> triangles;
};

/// Leaves out vertices, each while the surface stays within about `tolerance` (metres) of where it was, faces
/// its vertices' normals and has no slivers. The vertices that stay do not move. A closed 2-manifold remains
/// one, of the same genus. Triangles that go are dropped; vertices that go stay in the arrays, unused. On one
/// thread, about a microsecond a vertex.
void simplify_closed(CollapsibleMesh& mesh, double tolerance);

/// Which vertices triangles use, or `is_kept` names, in ascending order; the triangles are renumbered to
/// count these alone.
std::vector<std::uint32_t> drop_unused(std::vector<bool> is_kept, BulkVector<Triangle>& triangles);

}  // namespace ramify
