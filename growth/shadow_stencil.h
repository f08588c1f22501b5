// What one caster does to the voxels below it, ready to be added leaf by leaf.
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

/// Runs of voxels along z, level by level downwards. A caster's place along a leaf's edge is one of 8: for
/// each there is a pattern as wide as all the leaves that the stencil falls in, so that adding a row takes no
/// looking where it begins or ends.
class ShadowStencil {
 public:
  explicit ShadowStencil(const Penumbra& penumbra);
  ShadowStencil(const ShadowStencil&) = delete;
  ShadowStencil& operator=(const ShadowStencil&) = delete;

  /// Rows of one y, at consecutive x.
  struct Level {
    int y = 0;                           // relative to the caster
    int first_x = 0;                     // likewise
    std::vector<const Shadow*> amounts;  // of each row, for each place in turn

    int row_count() const { return static_cast<int>(amounts.size()) / kLeafEdge; }

    /// Of each row, leaves_wide() * 8 amounts for a caster at this place along a leaf's edge: the first of
    /// them is for the voxel where the leaf begins that the stencil begins in.
    const Shadow* const* amounts_at(int place) const { return amounts.data() + place * row_count(); }
  };

  const std::vector<Level>& levels() const { return levels_; }

  /// Box of what is shaded, relative to the caster.
  const Coord& low() const { return low_; }
  const Coord& high() const { return high_; }

  /// Leaves along z that the stencil of a caster may fall in, whatever its place.
  int leaves_wide() const { return leaves_wide_; }

  /// What a caster adds to its own voxel.
  Shadow own_shadow() const { return own_shadow_; }

 private:
  struct Row;
  static std::vector<Row> rows_of(const Penumbra& penumbra);

  std::vector<Level> levels_;
  std::vector<Shadow> amounts_;  // that the levels point to
  Coord low_{0};
  Coord high_{0};
  int leaves_wide_ = 1;
  Shadow own_shadow_ = 0;
};

}  // namespace ramify::growth
