// Hollows in a closed surface: pieces of it that face inwards.
#pragma once

#include <array>
#include <cstdint>

#include "common/base/bulk.h"
#include "common/base/geometry.h"

namespace ramify {

/// Drops the triangles of pieces that enclose a hollow: those whose volume is negative. O(n).
void fill_hollows(const BulkVector<Vec3f>& positions, BulkVector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace ramify
