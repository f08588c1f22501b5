// Which leaves of a voxel grid a field of wood passes through: cubes of 8 x 8 x 8 voxels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/mesh/field_items.h"

namespace ramify {

/// Voxels along a leaf's side.
inline constexpr int kLeafSide = 8;

/// Active voxels of a level set: those within so many voxels of the surface.
inline constexpr double kBandVoxels = 2.0;

/// Where the voxel of an index stands: between whole multiples of its size, so that a flat end at the origin
/// is not in a row of voxels.
inline Vec3 place_of(const Coord& voxel, double size) {
  return (Vec3(voxel) + 0.5) * size;
}

/// Along a curve that keeps near leaves near each other (G. M. Morton, 1966).
struct TouchedLeaves {
  std::vector<Coord> leaves;         // in units of leaves
  std::vector<std::size_t> first;    // of each leaf's items; one more at the end
  std::vector<std::uint32_t> items;  // in ascending order for each leaf

  std::span<const std::uint32_t> of(std::size_t leaf) const {
    return std::span(items).subspan(first[leaf], first[leaf + 1] - first[leaf]);
  }
};

/// All leaves within the band of the surface, each with the items that reach it, deep inside it too. Throws
/// RunError if the grid would be too wide for its indices. On all threads.
TouchedLeaves touched_leaves(const FieldItems& items, double voxel_size);

}  // namespace ramify
