// Hollows in a closed surface: pieces of it that face inwards.
#pragma once

#include "common/mesh/mesh.h"

namespace ramify {

/// Drops the triangles of pieces that enclose a hollow: those whose volume is negative. O(n).
void fill_hollows(const BulkVector<Vec3f>& positions, BulkVector<Triangle>& triangles);

}  // namespace ramify
