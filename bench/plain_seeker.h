// Where a shoot tends to, found voxel by voxel: what growth/environment_light.h is measured against.
#pragma once

#include <cmath>
#include <limits>

#include "growth/parameters.h"
#include "growth/shadow_grid.h"

namespace ramify::bench {

/// Reads a field of shadow, PlainShadow or DenseShadow.
class PlainSeeker {
 public:
  PlainSeeker(const growth::TreeParameters& tree, int step)
      : from_(tree.optimal_from),
        radius_(tree.r.at(step) + kConeSlack),
        min_cosine_(std::cos(radians(tree.theta_deg.at(step) / 2.0)) - kConeSlack),
        probe_(tree.probe_radius.at(step)),
        gradient_max_(tree.gradient_max.at(step)) {}

  template <class AnyShadow>
  Vec3 best_direction(const AnyShadow& shadow, const Vec3& apex, const Vec3& axis) const {
    return from_ == growth::OptimalFrom::gradient ? gradient(shadow, apex) : darkest_free(shadow, apex, axis);
  }

 private:
  // As in growth/: decided the same way, or the trees would differ.
  static constexpr double kConeSlack = 1e-6;

  /// The mean direction of the least shaded voxels in the cone.
  template <class AnyShadow>
  Vec3 darkest_free(const AnyShadow& shadow, const Vec3& apex, const Vec3& axis) const {
    const Vec3 place = apex / shadow.voxel_size();
    const Coord own = shadow.voxel_of(apex);
    const int reach = static_cast<int>(std::floor(radius_ + 0.5));
    growth::Shadow least = std::numeric_limits<growth::Shadow>::max();
    Vec3 sum(0.0);
    for (int i = -reach; i <= reach; ++i) {
      for (int j = -reach; j <= reach; ++j) {
        for (int k = -reach; k <= reach; ++k) {
          const Coord voxel = own + Coord(i, j, k);
          if (voxel == own) continue;
          const Vec3 to_voxel = Vec3(voxel) - place;
          const double distance = glm::length(to_voxel);
          if (distance > radius_ || glm::dot(to_voxel, axis) < min_cosine_ * distance) continue;
          const growth::Shadow found = shadow.at(voxel);
          if (found > least) continue;
          if (found < least) sum = Vec3(0.0);
          least = found;
          sum += glm::normalize(to_voxel);
        }
      }
    }
    return normalized_or(sum, axis);
  }

  /// Towards less shadow, no longer than the config lets it be.
  template <class AnyShadow>
  Vec3 gradient(const AnyShadow& shadow, const Vec3& apex) const {
    Vec3 slope(0.0);
    for (int i = 0; i < 3; ++i) {
      Vec3 step(0.0);
      step[i] = probe_ * shadow.voxel_size();
      slope[i] = (light(shadow, apex + step) - light(shadow, apex - step)) / (2.0 * probe_);
    }
    const double length = glm::length(slope);
    return length > gradient_max_ ? slope * (gradient_max_ / length) : slope;
  }

  /// Trilinear between the centres of voxels.
  template <class AnyShadow>
  static double light(const AnyShadow& shadow, const Vec3& point) {
    const Vec3 place = point / shadow.voxel_size();
    const Vec3 low = glm::floor(place);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const Coord offset(corner & 1, corner >> 1 & 1, corner >> 2);
      const Vec3 share = glm::mix(1.0 - (place - low), place - low, Vec3(offset));
      sum -= share.x * share.y * share.z * (shadow.at(Coord(low) + offset) * growth::kShadowUnit);
    }
    return sum;
  }

  growth::OptimalFrom from_;
  double radius_;  // voxels
  double min_cosine_;
  double probe_;  // voxels
  double gradient_max_;
};

}  // namespace ramify::bench
