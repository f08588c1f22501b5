// Tangents for normal maps, from positions, normals and texture coordinates alone.
// E. Lengyel, Computing Tangent Space Basis Vectors for an Arbitrary Mesh, Terathon Software, 2001.
#pragma once

#include "common/mesh/mesh.h"

namespace ramify {

/// Sets `mesh.tangents` from the triangles of those materials that have a normal map: unit length,
/// perpendicular to the normal, along +u; w = 1 where cross(normal, tangent) runs along +v, -1 where the
/// texture lies mirrored. A vertex without such triangles, or where u does not change, gets any tangent.
/// Clears them where no material has a normal map. O(n), on all threads, the same for any number of them.
void compute_tangents(Mesh& mesh);

/// Appends those of the overlay that was laid over the mesh since. O(triangles of the overlay).
void append_overlay_tangents(Mesh& mesh);

}  // namespace ramify
