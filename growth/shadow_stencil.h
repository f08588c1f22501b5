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

  /// Rows of one y, at consecutive x.
  struct Level {
    int y = 0;                            // relative to the caster
    int first_x = 0;                      // likewise
    std::vector<std::uint32_t> patterns;  // of each row, the first of its 8
  };

  const std::vector<Level>& levels() const { return levels_; }

  /// Box of what is shaded, relative to the caster.
  const Coord& low() const { return low_; }
  const Coord& high() const { return high_; }

  /// Leaves along z that the stencil of a caster may fall in, whatever its place.
  int leaves_wide() const { return leaves_wide_; }

  /// leaves_wide() * 8 amounts, the first of them in the leaf where the stencil begins.
  const Shadow* amounts(std::uint32_t pattern, int place) const {
    return amounts_.data() +
           (pattern + static_cast<std::uint32_t>(place)) * static_cast<std::size_t>(leaves_wide_ * kLeafEdge);
  }

  /// What a caster adds to its own voxel.
  Shadow own_shadow() const { return own_shadow_; }

 private:
  struct Row;
  static std::vector<Row> rows_of(const Penumbra& penumbra);

  std::vector<Level> levels_;
  std::vector<Shadow> amounts_;
  Coord low_{0};
  Coord high_{0};
  int leaves_wide_ = 1;
  Shadow own_shadow_ = 0;
};

}  // namespace ramify::growth
