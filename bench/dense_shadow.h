// The shadow field as the quickest public program has it: all voxels of the world in one array.
#pragma once

#include <vector>

#include "bench/plain_shadow.h"

namespace ramify::bench {

/// Additive shadow, the sun overhead, in units of 2^-16. A cube of so many voxels each way, the origin in the
/// middle of its ground; below that are as many levels as a shadow has.
class DenseShadow {
 public:
  DenseShadow(const growth::Penumbra& penumbra, double voxel_size, int voxels);

  double voxel_size() const { return voxel_size_; }
  Coord voxel_of(const Vec3& point) const { return Coord(glm::floor(point / voxel_size_ + 0.5)); }

  /// Adds the shadow of a caster standing in this voxel. Throws RunError where it leaves the cube.
  void cast(const Coord& caster);

  /// Outside of the cube 0.
  growth::Shadow at(const Coord& voxel) const {
    const Coord place = voxel + origin_;
    return holds(place) ? shadow_[index_of(place)] : 0;
  }

  /// What a caster adds to its own voxel.
  growth::Shadow own_shadow() const { return amounts_.front(); }

 private:
  bool holds(const Coord& place) const {
    return place.x >= 0 && place.y >= 0 && place.z >= 0 && place.x < side_ && place.y < side_ &&
           place.z < side_;
  }
  std::size_t index_of(const Coord& place) const {
    return (std::size_t(place.x) * std::size_t(side_) + std::size_t(place.y)) * std::size_t(side_) +
           std::size_t(place.z);
  }

  double voxel_size_;
  std::vector<growth::Shadow> amounts_;  // by level
  int side_;                             // voxels
  Coord origin_;                         // where the voxel (0, 0, 0) is in the cube
  std::vector<growth::Shadow> shadow_;   // of all voxels, z fastest
};

}  // namespace ramify::bench
