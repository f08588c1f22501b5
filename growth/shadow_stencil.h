// What one caster does to the voxels below it, ready to be added.
#pragma once

#include <cstdint>
#include <vector>

#include "common/base/geometry.h"
#include "growth/leaf_table.h"
#include "growth/parameters.h"

namespace ramify::growth {

inline constexpr double kShadowUnit = 1.0 / 65536.0;

/// What a caster does to the voxels below it.
struct Penumbra {
  ShadowModel model = ShadowModel::additive;
  double a = 0.2;            // additive: shadow in the caster's own voxel
  double b = 2.0;            // level q below it gets a * b^-q
  int q_max = 4;             // the last level; level q is 2q + 1 voxels wide
  Vec3 sun_direction = kUp;  // level q is shifted away from it, whole voxels
};

/// Written as changes along x: what the rows of a level have more, or less, than the row before them. All
/// rows of a level are often the same, so there are fewer changes than rows.
class ShadowStencil {
 public:
  explicit ShadowStencil(const Penumbra& penumbra);

  /// Amounts along z that are added to all rows of one y from some x on.
  struct Change {
    Coord first{0};               // the first amount's voxel, relative to the caster
    std::vector<Shadow> amounts;  // padded with zeros to a whole number of quads
  };

  const std::vector<Change>& changes() const { return changes_; }

  /// Box of what is shaded, relative to the caster.
  const Coord& low() const { return low_; }
  const Coord& high() const { return high_; }

  /// What a caster adds to its own voxel.
  Shadow own_shadow() const { return own_shadow_; }

 private:
  std::vector<Change> changes_;
  Coord low_{0};
  Coord high_{0};
  Shadow own_shadow_ = 0;
};

/// Shadows that are added in one instruction.
inline constexpr int kQuad = 4;

}  // namespace ramify::growth
