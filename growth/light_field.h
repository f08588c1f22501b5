// The shadow grid read as light.
#pragma once

#include <cstdint>

#include "growth/shadow_grid.h"

namespace ramify::growth {

/// Reads one grid; any number of threads may ask.
class LightField {
 public:
  /// `seed` is the world's: the multiplicative model's sky is uneven, from 0.95 to 1 a voxel.
  LightField(const ShadowGrid& grid, ShadowModel model, std::uint64_t seed)
      : grid_(grid), model_(model), seed_(seed) {}

  const ShadowGrid& grid() const { return grid_; }

  /// All that darkens a voxel, `shadow` being what the grid has there: the less, the more light there is.
  Shadow shade(const Coord& voxel, Shadow shadow) const {
    return model_ == ShadowModel::additive ? shadow : shadow + uneven_sky(voxel);
  }

  /// Light between the centres of voxels, trilinear. Additive: what is taken from full exposure, 0 or less.
  /// Multiplicative: the share of it that is left.
  double light(const Vec3& point) const;

  /// The gradient of light(), by central differences over `probe` voxels each way; 1 / voxel.
  Vec3 slope(const Vec3& point, double probe) const;

 private:
  Shadow uneven_sky(const Coord& voxel) const;
  double light_in(const Coord& voxel, LeafReader& reader) const;
  double light(const Vec3& point, LeafReader& reader) const;

  const ShadowGrid& grid_;
  ShadowModel model_;
  std::uint64_t seed_;
};

}  // namespace ramify::growth
