#include "common/volume/voxel_file.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

namespace ramify {

void write_vdb(const VoxelLayer& layer, const std::string& grid_name, std::ostream& out) {
  openvdb::initialize();
  const auto grid = openvdb::FloatGrid::create(0.0f);
  grid->setName(grid_name);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(layer.voxel_size));
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  auto accessor = grid->getAccessor();
  for (std::size_t i = 0; i < layer.voxels.size(); ++i) {
    const Coord& voxel = layer.voxels[i];
    accessor.setValueOn({voxel.x, voxel.y, voxel.z}, layer.values[i]);
  }
  openvdb::io::Stream(out).write({grid});
}

}  // namespace ramify
