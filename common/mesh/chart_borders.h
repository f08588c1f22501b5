// Where the bark of two axes meets on a surface that was not made tube by tube.
#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/mesh.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// Cuts the triangles whose corners belong to several axes along the line where the wood of two axes is
/// equally near, so that charts meet in a smooth curve. Single vertices of an axis go to the one next to them
/// before that: mesh.internodes changes. New vertices, on the edges between, come at the end of the arrays;
/// the surface stays as it is. Returns an internode for each triangle, of the one axis that it now lies on.
/// mesh.uvs are not set. O(n), and a sort of the edges cut.
std::vector<std::uint32_t> cut_between_axes(const Skeleton& skeleton, Mesh& mesh);

}  // namespace ramify
