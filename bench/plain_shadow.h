// The shadow field as one would first write it: an OpenVDB grid that is reached voxel by voxel through its
// value accessor. What growth/shadow_grid.h is measured against.
#pragma once

#include <memory>
#include <vector>

#include "common/base/geometry.h"
#include "growth/shadow_grid.h"

namespace ramify::bench {

/// What a caster adds to each voxel, level by level from its own.
std::vector<growth::Shadow> shadow_by_level(const growth::Penumbra& penumbra);

/// Additive shadow, the sun overhead, in units of 2^-16.
class PlainShadow {
 public:
  PlainShadow(const growth::Penumbra& penumbra, double voxel_size);
  PlainShadow(PlainShadow&& other) noexcept;
  ~PlainShadow();

  double voxel_size() const { return voxel_size_; }
  Coord voxel_of(const Vec3& point) const { return Coord(glm::floor(point / voxel_size_ + 0.5)); }

  void clear();

  /// Adds the shadow of a caster standing in this voxel.
  void cast(const Coord& caster);

  growth::Shadow at(const Coord& voxel) const;

  /// What a caster adds to its own voxel.
  growth::Shadow own_shadow() const { return amounts_.front(); }

 private:
  struct Grid;

  double voxel_size_;
  std::vector<growth::Shadow> amounts_;  // by level
  std::unique_ptr<Grid> grid_;
};

}  // namespace ramify::bench
