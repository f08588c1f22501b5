// The shadow field of Palubicki et al. 2009, 4.1: every caster darkens a pyramid of voxels below it. Held in
// an OpenVDB grid without edges, in whole units of 2^-16, so that sums are exact in any order and taking a
// shadow away leaves nothing of it.
#pragma once

#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "common/config/layer.h"
#include "growth/leaf_table.h"
#include "growth/shadow_stencil.h"

namespace ramify::growth {

/// Additive shadow is taken from the light; multiplicative shadow s leaves exp(-s) of it.
class ShadowGrid {
 public:
  /// `voxel_size` in metres.
  ShadowGrid(const Penumbra& penumbra, double voxel_size);
  ~ShadowGrid();

  double voxel_size() const { return voxel_size_; }

  /// The voxel that holds `point`; its centre is voxel_size * (i, j, k), so the root is in the middle of one.
  Coord voxel_of(const Vec3& point) const { return voxel_at(glm::floor(point / voxel_size_ + 0.5)); }

  /// The voxel with these whole numbers.
  static Coord voxel_at(const Vec3& numbers) {
    // Indices stay where sums of a few of them cannot overflow.
    constexpr double kMaxIndex = 1 << 28;
    return Coord(glm::clamp(numbers, Vec3(-kMaxIndex), Vec3(kMaxIndex)));
  }

  /// Adds the shadows of the casters in the first voxels and takes those in the second away; a voxel may be
  /// named more than once. O(casters), on all threads.
  void change(std::span<const Coord> added, std::span<const Coord> removed);
  void cast(std::span<const Coord> casters) { change(casters, {}); }
  void uncast(std::span<const Coord> casters) { change({}, casters); }

  /// Adds `amount` to each of these voxels and to no other.
  void darken(std::span<const Coord> voxels, Shadow amount);

  Shadow at(const Coord& voxel) const {
    const std::uint32_t leaf = leaves_.find(leaf_of(voxel));
    return leaf == 0 ? 0 : leaves_.buffer(leaf)[place_in_leaf(voxel)];
  }
  Shadow at(Site site) const { return leaves_.at(site); }
  void prefetch(Site site) const { leaves_.prefetch(site); }
  void prefetch(const Coord& voxel) const {
    prefetch(leaves_.find(leaf_of(voxel)) * kLeafSize + place_in_leaf(voxel));
  }
  LeafReader reader() const { return LeafReader(leaves_); }

  /// For quick reading: valid as long as the grid.
  Site site_of(const Coord& voxel);

  /// Likewise; 0 where no shadow has come near the voxel and nobody has asked for its site.
  Site known_site_of(const Coord& voxel) const {
    const std::uint32_t leaf = leaves_.find(leaf_of(voxel));
    return leaf == 0 ? 0 : leaf * kLeafSize + place_in_leaf(voxel);
  }

  /// What a caster adds to its own voxel.
  Shadow own_shadow() const { return stencil_.own_shadow(); }

  /// All voxels in shadow, as shadow values.
  VoxelLayer layer() const;

 private:
  struct Tree;

  std::uint32_t touch(const Coord& leaf);
  void touch_all(const Coord& first, const Coord& last);

  double voxel_size_;
  ShadowStencil stencil_;
  std::unique_ptr<Tree> tree_;
  LeafTable leaves_;                                                  // of the tree
  std::unordered_map<std::uintptr_t, std::uint32_t> leaves_in_page_;  // large pages
};

}  // namespace ramify::growth
