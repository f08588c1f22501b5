// The parts of a wood field under one number, and which of them can shape the surface where.
#pragma once

#include <cstdint>
#include <span>

#include "common/mesh/wood_field.h"

namespace ramify {

/// Cones first, then forks.
class FieldItems {
 public:
  /// `field` must outlive it.
  explicit FieldItems(const WoodField& field)
      : field_(field), cone_count_(static_cast<std::uint32_t>(field.cones.size())) {}

  std::size_t size() const { return cone_count_ + field_.forks.size(); }
  bool is_cone(std::uint32_t item) const { return item < cone_count_; }
  const RoundCone& cone(std::uint32_t item) const { return field_.cones[item]; }
  const ForkBlend& fork(std::uint32_t item) const { return field_.forks[item - cone_count_]; }
  Box bounds(std::uint32_t item) const;

  /// Whether the item can shape the surface within `radius` of `center`, metres: a cone that comes near it, a
  /// fork that blends there.
  bool can_matter(std::uint32_t item, const Vec3& center, double radius) const;

  /// Of the union of what these items' cones are, metres.
  double union_distance(std::span<const std::uint32_t> items, const Vec3& point) const;

 private:
  const WoodField& field_;
  std::uint32_t cone_count_;
};

}  // namespace ramify
