// Fewer triangles where a closed surface is nearly flat: half-edge collapses that keep it a closed manifold.
// H. Hoppe et al., Mesh optimization, SIGGRAPH 1993: an edge may go if its ends have two neighbours in
// common.
#pragma once

#include "common/mesh/closed_surface.h"

namespace ramify {

/// Leaves out vertices, each while the surface stays within about `tolerance` (metres) of where it was, faces
/// its vertices' normals and has no slivers. The vertices that stay do not move. A closed 2-manifold remains
/// one, of the same genus. On all threads; the same for any number of them.
void simplify_closed(ClosedSurface& surface, double tolerance);

}  // namespace ramify
