// What shoots cannot grow through: the ground and obstacles.
#pragma once

#include <vector>

#include "growth/parameters.h"

namespace ramify::growth {

class Barriers {
 public:
  explicit Barriers(const Parameters& world);

  /// Sets the height of the ground, which may change in time.
  void set_step(int step);

  /// Whether an internode cannot run from `from` to `to`. Its whole length is tested against obstacles; that
  /// it begins above ground is taken for granted. O(obstacles).
  bool block(const Vec3& from, const Vec3& to) const;

 private:
  bool has_ground_;
  Schedule ground_schedule_;
  double ground_y_ = 0.0;
  std::vector<Solid> solids_;
};

/// The voxels of size `voxel_size`, centred on whole multiples of it, whose centres lie in `volume`. O(voxels
/// of its box).
std::vector<Coord> voxels_inside(const Volume& volume, double voxel_size);

}  // namespace ramify::growth
