// A wood field near one leaf of a voxel grid, for many points at a time: in voxels about the leaf's middle,
// in floats, so that several points go through each instruction.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/mesh/field_items.h"

namespace ramify {

/// Points that are looked at together.
inline constexpr int kBatch = 64;

using Lane = std::array<float, kBatch>;

/// Of places: voxels about the leaf's middle. Of what is found there: the distance to the surface, voxels,
/// negative inside; how it grows, a vector no longer than 1; the skeleton node of the nearest cone.
struct alignas(64) Batch {
  int lanes = kBatch;  // how many of the places count: a multiple of 8
  Lane x, y, z;
  Lane value;
  Lane slope_x, slope_y, slope_z;
  std::array<std::uint32_t, kBatch> internode;
};

class LeafField {
 public:
  /// Takes over the items that touch a leaf whose middle is `center`, metres. Keeps its memory.
  void reset(const FieldItems& items, std::span<const std::uint32_t> touching, const Vec3& center,
             double voxel_size);

  /// Chooses what shapes the field within `radius` of a place, both in voxels. Until the next call only
  /// batches of points in that ball may be looked at.
  void focus(const Vec3f& place, float radius);

  /// Nothing in the ball of the focus has a smaller or a greater value.
  float least() const { return least_; }
  float greatest() const { return greatest_; }

  /// Sets the values of all of the batch.
  void values(Batch& batch) const;

  /// Sets values, slopes and internodes. Where forks blend, the slope leaves out how the blend's own width
  /// changes: it is off by a tenth at most.
  void slopes(Batch& batch) const;

 private:
  struct Cone {
    Vec3f base;
    Vec3f along;
    float length;
    float base_radius;
    float sine;
    float tangent;
    Vec3f cut;
    float cut_offset;
    bool has_cut;
    std::uint32_t internode;
  };
  struct Blend {
    Vec3f center;
    float zone;
    float width;
    Vec3f cut;
    float cut_offset;
    std::vector<std::uint32_t> cones;  // indices into cones_
    std::vector<std::uint32_t> others;
  };
  struct Nearest;

  /// Of a point's nearest ball: from its centre to the point, how far that is, and the distance to its
  /// surface.
  struct Foot {
    float x, y, z;
    float apart;
    float value;
  };

  static Foot foot_of(const Cone& cone, float x, float y, float z);
  static void lower_values(const Cone& cone, Batch& batch);
  void find_nearest(std::span<const std::uint32_t> cones, const Batch& batch, Nearest& nearest) const;
  void blend(const Blend& fork, Batch& batch, bool with_slopes) const;

  std::vector<Cone> cones_;
  std::vector<Blend> blends_;
  std::size_t blend_count_ = 0;        // of blends_: the others keep their memory
  std::vector<std::uint32_t> global_;  // of cones_: their number in the field
  // Of the focus:
  std::vector<float> distances_;
  std::vector<std::uint32_t> near_cones_;
  std::vector<Blend> near_blends_;
  std::size_t near_blend_count_ = 0;
  float least_ = 0.0f;
  float greatest_ = 0.0f;
};

}  // namespace ramify
