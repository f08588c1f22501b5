#include "bench/dense_shadow.h"

#include <fmt/format.h>

#include "common/base/errors.h"

namespace ramify::bench {

DenseShadow::DenseShadow(const growth::Penumbra& penumbra, double voxel_size, int voxels)
    : voxel_size_(voxel_size),
      amounts_(shadow_by_level(penumbra)),
      side_(voxels),
      origin_(voxels / 2, penumbra.q_max, voxels / 2),
      shadow_(std::size_t(voxels) * std::size_t(voxels) * std::size_t(voxels)) {}

void DenseShadow::cast(const Coord& caster) {
  const Coord top = caster + origin_;
  const int last = static_cast<int>(amounts_.size()) - 1;
  if (!holds(top - last) || !holds(top + Coord(last, 0, last))) {
    throw RunError(fmt::format("a shadow leaves the dense field of {} voxels each way", side_));
  }
  for (int q = 0; q <= last; ++q) {
    const growth::Shadow amount = amounts_[static_cast<std::size_t>(q)];
    for (int i = -q; i <= q; ++i) {
      for (int k = -q; k <= q; ++k) shadow_[index_of(top + Coord(i, -q, k))] += amount;
    }
  }
}

}  // namespace ramify::bench
