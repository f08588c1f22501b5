// What a bud sees of the shadow field: its light exposure and the direction in which there is most light.
// Palubicki et al. 2009, 4.1.
#pragma once

#include <span>
#include <vector>

#include "growth/light_field.h"
#include "growth/plant.h"

namespace ramify::growth {

/// Light exposure Q of each bud of a tree. Additive shadow: Q = max(C - s + a, 0), where a
/// bud whose own node (casters: metamers) or self (buds) casts gets its own shadow back: nothing shades
/// itself. Multiplicative: C times the share of light that is left.
void sense_light(const Plant& plant, const Parameters& world, const TreeParameters& tree,
                 const LightField& field, int step, MappedVector<double>& light);

/// Whether a metamer made at `birth_step` casts shadow in `step`.
inline bool has_leaves(const Parameters& world, int birth_step, int step) {
  return world.leaf_lifespan == 0 || step - birth_step <= world.leaf_lifespan;
}

/// Finds V, the direction of growth with most light. One a step: keeps the shape of the cone.
class LightSeeker {
 public:
  LightSeeker(const TreeParameters& tree, const LightField& field, int step);

  /// V for growth from `apex` in the unit direction `axis`. A unit vector (darkest-free), or the slope of the
  /// light, no longer than gradient_max.
  Vec3 best_direction(const Vec3& apex, const Vec3& axis) const;

  /// Begins to fetch what best_direction() will read.
  void prefetch(const Vec3& apex, const Vec3& axis) const;

 private:
  /// Whether a voxel is near enough, `square` being the square of its distance, and within the cone, `along`
  /// being its place along the axis; voxels.
  bool is_in_cone(double square, double along) const;
  std::span<Coord> find_in_cone(const Vec3& place, const Coord& own, const Vec3& axis) const;
  Vec3 darkest_free(const Vec3& apex, const Vec3& axis) const;
  Vec3 gradient(const Vec3& apex) const;

  const LightField& field_;
  OptimalFrom from_;
  double radius_;      // voxels
  double min_cosine_;  // of theta / 2
  double sine_;        // likewise
  Tie tie_;
  double probe_radius_;  // voxels
  double gradient_max_;
};

}  // namespace ramify::growth
