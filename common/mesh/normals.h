// Normals for meshes that came without.
#pragma once

#include "common/mesh/mesh.h"

namespace ramify {

/// Sets the normals of the vertices from `first_vertex` on to the mean of their triangles', by area; those
/// triangles are all from `first_triangle` on. A vertex without triangles gets +Y. O(n).
void compute_normals(Mesh& mesh, std::size_t first_vertex = 0, std::size_t first_triangle = 0);

}  // namespace ramify
