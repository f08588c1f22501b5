// The surface of a volume of any shape as triangles, to be looked at.
// K. Museth, VDB: High-Resolution Sparse Volumes with Dynamic Topology, ACM Trans. Graph. 32(3), 2013.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/base/geometry.h"
#include "common/volume/volume.h"

namespace ramify {

/// Counter-clockwise seen from outside.
struct VolumeSurface {
  std::vector<Vec3f> positions;  // metres
  std::vector<Vec3f> normals;    // unit length, one a position
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A box by its corners. Of the others so many voxels along the longest side are looked at, more where the
/// volume is thin: faces lie where they are, edges are rounded by a voxel, and what a difference leaves
/// thinner than a voxel is lost. Empty for an empty volume. Throws InputError if a sketch or mesh cannot be
/// read. About 20 ms for 128 voxels.
VolumeSurface surface_of(const Volume& volume, int voxels);

}  // namespace ramify
