// What a bud sees of the shadow field: its light exposure and the direction in which there is most light.
// Palubicki et al. 2009, 4.1.
#pragma once

#include <vector>

#include "growth/plant.h"
#include "growth/shadow_grid.h"

namespace ramify::growth {

/// Light exposure Q = max(C - s + a, 0) of each bud. A bud whose own node (casters: metamers) or self (buds)
/// casts gets its own shadow back: nothing shades itself.
void sense_light(const Plant& plant, const Parameters& parameters, const ShadowGrid& shadow, int step,
                 std::vector<double>& light);

/// Looks for the voxels with least shadow in a cone. One an instant: keeps the shape of the cone.
class LightSeeker {
 public:
  LightSeeker(const Parameters& parameters, const ShadowGrid& shadow, int step);

  /// The unit direction from `apex` to the least shaded voxels whose centres lie within radius r and theta /
  /// 2 of `axis`, but for the voxel of `apex` itself; `axis` where there are none or they cancel out.
  Vec3 best_direction(const Vec3& apex, const Vec3& axis) const;

 private:
  const ShadowGrid& shadow_;
  double radius_;      // metres
  double min_cosine_;  // of theta / 2
  int reach_;          // voxels looked at on each side
  Tie tie_;
};

}  // namespace ramify::growth
