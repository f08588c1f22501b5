// Volumes of any shape as points on their surfaces.
#pragma once

#include <vector>

#include "common/base/geometry.h"
#include "common/config/field.h"
#include "common/volume/volume.h"

namespace ramify {

/// Middles of the cells that the surface goes through, of `cells` along the longest side; none for an empty
/// volume or one that cannot be read.
std::vector<Vec3> surface_points(const Volume& volume, int cells);

/// All volumes that stand in a table's owner, at any depth; parts of volumes are not listed. The addresses
/// are the owner's.
std::vector<const Volume*> volumes_in(const Table& table, void* owner);

}  // namespace ramify
