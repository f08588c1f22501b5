#include "bench/plain_shadow.h"

#include <openvdb/openvdb.h>

namespace ramify::bench {

std::vector<growth::Shadow> shadow_by_level(const growth::Penumbra& penumbra) {
  std::vector<growth::Shadow> amounts;
  for (int q = 0; q <= penumbra.q_max; ++q) {
    const double shadow = penumbra.a * std::pow(penumbra.b, -q);
    amounts.push_back(static_cast<growth::Shadow>(std::lround(shadow / growth::kShadowUnit)));
  }
  return amounts;
}

struct PlainShadow::Grid {
  openvdb::Int32Grid::Ptr voxels = openvdb::Int32Grid::create(0);
  openvdb::Int32Grid::Accessor accessor = voxels->getAccessor();
};

PlainShadow::PlainShadow(const growth::Penumbra& penumbra, double voxel_size)
    : voxel_size_(voxel_size), amounts_(shadow_by_level(penumbra)), grid_(std::make_unique<Grid>()) {}

PlainShadow::PlainShadow(PlainShadow&&) noexcept = default;

PlainShadow::~PlainShadow() = default;

void PlainShadow::clear() {
  grid_->voxels->clear();
}

void PlainShadow::cast(const Coord& caster) {
  for (int q = 0; q < static_cast<int>(amounts_.size()); ++q) {
    const growth::Shadow amount = amounts_[static_cast<std::size_t>(q)];
    for (int i = -q; i <= q; ++i) {
      for (int k = -q; k <= q; ++k) {
        grid_->accessor.modifyValue({caster.x + i, caster.y - q, caster.z + k},
                                    [amount](growth::Shadow& shadow) { shadow += amount; });
      }
    }
  }
}

growth::Shadow PlainShadow::at(const Coord& voxel) const {
  return grid_->accessor.getValue({voxel.x, voxel.y, voxel.z});
}

}  // namespace ramify::bench
