// The shadow field of Palubicki et al. 2009, 4.1: every caster darkens a pyramid of voxels below it. Held in
// an OpenVDB grid without edges, in whole units of 2^-16, so that sums are exact in any order and taking a
// shadow away leaves nothing of it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/base/geometry.h"
#include "common/config/layer.h"

namespace ramify::growth {

struct Penumbra {
  double a = 0.2;  // shadow in the caster's own voxel
  double b = 2.0;  // level q below it gets a * b^-q
  int q_max = 4;   // the last level; level q is 2q + 1 voxels wide
};

/// Shadow in units of 2^-16.
using Shadow = std::int32_t;
inline constexpr double kShadowUnit = 1.0 / 65536.0;

class ShadowGrid {
 public:
  /// `voxel_size` in metres.
  ShadowGrid(const Penumbra& penumbra, double voxel_size);
  ~ShadowGrid();

  double voxel_size() const { return voxel_size_; }

  /// The voxel that holds `point`; its centre is voxel_size * (i, j, k), so the root is in the middle of one.
  Coord voxel_of(const Vec3& point) const;

  /// Adds the pyramids of casters standing in these voxels; a voxel may be named more than once.
  void cast(std::span<const Coord> casters);

  /// Takes them away again.
  void uncast(std::span<const Coord> casters);

  Shadow at(const Coord& voxel) const;

  /// The cube of edge^3 voxels from `low` on, z fastest; `values` has room for them.
  void gather(const Coord& low, int edge, std::span<Shadow> values) const;

  /// What a caster adds to its own voxel.
  Shadow own_shadow() const { return levels_.front(); }

  /// All voxels in shadow, as shadow values.
  VoxelLayer layer() const;

 private:
  struct Field;  // the OpenVDB tree and a dense table of its leaves

  void add(std::span<const Coord> casters, Shadow sign);

  double voxel_size_;
  std::vector<Shadow> levels_;  // what a caster adds on each level, rounded once
  std::unique_ptr<Field> field_;
};

}  // namespace ramify::growth
