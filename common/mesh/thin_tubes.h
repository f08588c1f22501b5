// Twigs too thin for a watertight mesh's voxels, as tubes that are closed each for itself.
#pragma once

#include <vector>

#include "common/mesh/mesh.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// Adds a tube of `sides` sides, flat at both ends, for each chain of internodes of one axis for which
/// is_tube is true; it begins on the centre line of what it grows from. Internodes shorter than they are
/// thick are drawn together. Returns how many tubes. Ranges are left as they are. O(n).
std::size_t add_thin_tubes(const Skeleton& skeleton, const std::vector<bool>& is_tube, int sides, Mesh& mesh);

}  // namespace ramify
