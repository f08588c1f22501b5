// A field of wood as a level set: OpenVDB voxels near its surface whose inside is well-composed.
// K. Museth, VDB: High-Resolution Sparse Volumes with Dynamic Topology, ACM Trans. Graph. 32(3), 2013.
// L. Latecki, U. Eckhardt, A. Rosenfeld, Well-composed sets, Comput. Vis. Image Underst. 61(1), 1995.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/base/parallel.h"
#include "common/mesh/touched_leaves.h"

namespace ramify {

struct VoxelGrid;  // OpenVDB's tree, which wood_voxels.cpp alone knows

/// Values are distances in voxels, cut off a little beyond the band.
struct WoodVoxels {
  double voxel_size = 0.0;  // metres
  TouchedLeaves touched;
  std::shared_ptr<VoxelGrid> grid;  // its leaves are those of `touched`
  std::size_t active_voxels = 0;

  /// The leaf's first voxel.
  Coord origin_of(std::size_t leaf) const { return touched.leaves[leaf] * kLeafSide; }

  Vec3 middle_of(std::size_t leaf) const {
    return (Vec3(touched.leaves[leaf]) + 0.5) * (kLeafSide * voxel_size);
  }
};

/// Looks voxels up, soonest near the last one: each thread has its own.
class VoxelReader {
 public:
  explicit VoxelReader(const WoodVoxels& voxels);
  ~VoxelReader();

  float value(const Coord& voxel) const;

  /// The number of the leaf that has the voxel; nullopt if the surface does not come near.
  std::optional<std::size_t> leaf_at(const Coord& voxel) const;

 private:
  friend class LeafWindow;
  friend class LeafSigns;
  struct Access;
  std::unique_ptr<Access> access_;
};

/// On all threads: body(leaf's number, a reader of the thread's own).
template <class Body>
void for_each_leaf(const WoodVoxels& voxels, Body body) {
  parallel_for(voxels.touched.leaves.size(), 16, [&](std::size_t begin, std::size_t end) {
    const VoxelReader reader(voxels);
    for (std::size_t i = begin; i < end; ++i) body(i, reader);
  });
}

/// Some of the cells of a leaf; they count along z first, then y, then x.
class CellMask {
 public:
  void add(int x, int y, int z) { slices_[static_cast<std::size_t>(x)] |= bit(y, z); }

  std::size_t count() const { return count_before(kLeafSide, 0, 0); }

  /// How many of them come before this one.
  std::size_t count_before(int x, int y, int z) const {
    std::size_t result = 0;
    for (int before = 0; before < x; ++before) {
      result += static_cast<std::size_t>(std::popcount(slices_[static_cast<std::size_t>(before)]));
    }
    if (x == kLeafSide) return result;
    const std::uint64_t slice = slices_[static_cast<std::size_t>(x)] & (bit(y, z) - 1);
    return result + static_cast<std::size_t>(std::popcount(slice));
  }

  /// Calls body(x, y, z) for each, in order.
  template <class Body>
  void for_each(Body body) const {
    for (int x = 0; x < kLeafSide; ++x) {
      for (std::uint64_t left = slices_[static_cast<std::size_t>(x)]; left != 0; left &= left - 1) {
        const int place = std::countr_zero(left);
        body(x, place / kLeafSide, place % kLeafSide);
      }
    }
  }

 private:
  static constexpr std::uint64_t bit(int y, int z) { return std::uint64_t{1} << (y * kLeafSide + z); }

  std::array<std::uint64_t, kLeafSide> slices_{};  // one an x
};

/// The cell of a voxel has it and its neighbours on the upper sides as its eight corners, corner i at
/// (i / 4, i / 2 % 2, i % 2).
using CellCorners = std::array<float, 8>;

/// The voxels of a leaf and their neighbours on the upper sides: the corners of its cells.
class LeafWindow {
 public:
  LeafWindow(std::size_t leaf, const VoxelReader& voxels);

  float at(int x, int y, int z) const { return values_[index(x, y, z)]; }
  CellCorners corners(int x, int y, int z) const;

 private:
  static constexpr int kSide = kLeafSide + 1;

  static constexpr std::size_t index(int x, int y, int z) {
    return static_cast<std::size_t>((x * kSide + y) * kSide + z);
  }

  std::array<float, kSide * kSide * kSide> values_;
};

/// Which voxels of a leaf, and of their neighbours on the upper sides, are inside: a row along z at a time.
class LeafSigns {
 public:
  LeafSigns(std::size_t leaf, const VoxelReader& voxels);

  /// Bit z: voxel (x, y, z) is inside; 0 <= x, y, z <= kLeafSide.
  unsigned row(int x, int y) const { return rows_[static_cast<std::size_t>(x * (kLeafSide + 1) + y)]; }

  /// Bit z: the surface passes the cell of voxel (x, y, z); x, y, z < kLeafSide.
  unsigned crossed_cells(int x, int y) const;

 private:
  std::array<std::uint16_t, (kLeafSide + 1) * (kLeafSide + 1)> rows_;
};

/// Calls body(x, y, z) for each cell of a leaf that the surface passes, in the order of their numbers.
template <class Body>
void for_each_crossed_cell(const LeafSigns& signs, Body body) {
  for (int x = 0; x < kLeafSide; ++x) {
    for (int y = 0; y < kLeafSide; ++y) {
      for (unsigned left = signs.crossed_cells(x, y); left != 0; left &= left - 1) {
        body(x, y, std::countr_zero(left));
      }
    }
  }
}

/// Rasterises the field, then fills voxels, nearest to the surface first, until no two parts of the inside or
/// of the outside touch at an edge or a corner alone: then the surface has one sheet in each cell. On all
/// threads; the same for any number of them. Throws RunError if the grid would be too wide.
WoodVoxels wood_voxels(const FieldItems& items, double voxel_size);

}  // namespace ramify
