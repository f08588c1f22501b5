// Voxel layers as OpenVDB files.
#pragma once

#include <iosfwd>
#include <string>

#include "common/config/layer.h"

namespace ramify {

/// A FloatGrid called `grid_name`, in world units: background 0, the layer's voxels active.
void write_vdb(const VoxelLayer& layer, const std::string& grid_name, std::ostream& out);

}  // namespace ramify
