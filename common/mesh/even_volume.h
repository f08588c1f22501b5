// Vertices that lie in a curved surface make triangles inside it: moved outwards a little, they enclose what
// the surface does.
#pragma once

#include <vector>

#include "common/mesh/mesh.h"

namespace ramify {

/// Moves the vertices that can along their normals, so that triangles lie as far outside the surface as
/// inside, where it is a quadric; in hollow places inwards. Edges across a crease count as flat. O(n).
void even_volume(const BulkVector<Vec3f>& normals, const BulkVector<Triangle>& triangles,
                 const std::vector<bool>& can_move, BulkVector<Vec3f>& positions);

}  // namespace ramify
