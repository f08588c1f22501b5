// Where the leaves of a sparse grid are: their buffers by number, and their numbers by place. A leaf is a
// cube of 8 x 8 x 8 voxels, z fastest.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "common/base/geometry.h"

namespace ramify::growth {

/// Shadow in units of 2^-16.
using Shadow = std::int32_t;

inline constexpr int kLeafShift = 3;
inline constexpr int kLeafEdge = 1 << kLeafShift;  // voxels
inline constexpr std::uint32_t kLeafSize = kLeafEdge * kLeafEdge * kLeafEdge;

/// The address of a voxel: 512 times its leaf's number plus its place in it.
using Site = std::uint32_t;

inline Coord leaf_of(const Coord& voxel) {
  return {voxel.x >> kLeafShift, voxel.y >> kLeafShift, voxel.z >> kLeafShift};
}

inline std::uint32_t place_in_leaf(const Coord& voxel) {
  constexpr int mask = kLeafEdge - 1;
  return static_cast<std::uint32_t>(((voxel.x & mask) << (2 * kLeafShift)) +
                                    ((voxel.y & mask) << kLeafShift) + (voxel.z & mask));
}

class LeafTable {
 public:
  /// The number of a leaf, 0 if there is none there.
  std::uint32_t find(const Coord& leaf) const {
    const std::size_t index = index_of(leaf);
    return index != kOutside ? numbers_[index] : find_outside(leaf);
  }

  /// Numbers a new leaf; valid until the grid is gone.
  std::uint32_t add(const Coord& leaf, Shadow* buffer);

  /// Makes room for the leaves from `first` to `last`, and for some more steps. Those for which that would
  /// take too much memory are looked up in a slower way.
  void reserve(const Coord& first, const Coord& last);

  Shadow* buffer(std::uint32_t number) const { return buffers_[number]; }
  std::uint32_t count() const { return static_cast<std::uint32_t>(buffers_.size()); }  // with the empty 0

  Shadow at(Site site) const { return buffers_[site / kLeafSize][site % kLeafSize]; }
  void prefetch(Site site) const {
    if (site >= kLeafSize) __builtin_prefetch(buffers_[site / kLeafSize] + site % kLeafSize);
  }

 private:
  struct Hash {
    std::size_t operator()(const Coord& c) const {
      return static_cast<std::size_t>(c.x) * 73856093u ^ static_cast<std::size_t>(c.y) * 19349663u ^
             static_cast<std::size_t>(c.z) * 83492791u;
    }
  };

  static constexpr std::size_t kOutside = ~std::size_t{0};

  std::size_t index_of(const Coord& leaf) const {
    const auto x = static_cast<std::uint32_t>(leaf.x - low_.x);
    const auto y = static_cast<std::uint32_t>(leaf.y - low_.y);
    const auto z = static_cast<std::uint32_t>(leaf.z - low_.z);
    const bool is_inside = x < static_cast<std::uint32_t>(size_.x) &&
                           y < static_cast<std::uint32_t>(size_.y) && z < static_cast<std::uint32_t>(size_.z);
    if (!is_inside) return kOutside;
    return (std::size_t{x} * static_cast<std::size_t>(size_.y) + y) * static_cast<std::size_t>(size_.z) + z;
  }

  std::uint32_t find_outside(const Coord& leaf) const;

  Coord low_{0};  // the table's box; empty at first
  Coord size_{0};
  std::vector<std::uint32_t> numbers_;
  std::vector<Shadow*> buffers_{nullptr};                   // from number 1
  std::vector<Coord> leaves_{Coord(0)};                     // likewise
  std::unordered_map<Coord, std::uint32_t, Hash> outside_;  // the leaves beyond the table
};

/// Reads voxels that lie near each other: remembers the last leaf.
class LeafReader {
 public:
  explicit LeafReader(const LeafTable& table) : table_(table) {}

  Shadow at(const Coord& voxel) {
    const Coord leaf = leaf_of(voxel);
    if (leaf != leaf_) {
      leaf_ = leaf;
      buffer_ = table_.buffer(table_.find(leaf));
    }
    return buffer_ ? buffer_[place_in_leaf(voxel)] : 0;
  }

 private:
  const LeafTable& table_;
  Coord leaf_{std::numeric_limits<int>::max()};
  const Shadow* buffer_ = nullptr;
};

}  // namespace ramify::growth
