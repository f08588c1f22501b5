// Volumes of any shape as points on their surfaces.
#pragma once

#include <vector>

#include "common/base/geometry.h"
#include "common/volume/volume.h"

namespace ramify {

/// Middles of the cells that the surface goes through, of `cells` along the longest side; none for an empty
/// volume or one that cannot be read.
std::vector<Vec3> surface_points(const Volume& volume, int cells);

}  // namespace ramify
