// The wood of a tree as a field of distances: round cones, one an internode, that blend into each other where
// a lateral leaves its parent. Blending only where the surfaces meet at an angle, so that nothing bulges: O.
// Gourmel et al., A gradient-based implicit blend, ACM Trans. Graph. 32(2), 2013.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/geometry.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// Metres to a surface, negative inside, and the unit vector in which it grows fastest.
struct Distance {
  double value = 0.0;
  Vec3 gradient = kUp;
};

/// The hull of two balls.
class RoundCone {
 public:
  /// `cut`: what lies behind the plane through `base` with this normal is cut off; 0: nothing.
  RoundCone(const Vec3& base, double base_radius, const Vec3& tip, double tip_radius, const Vec3& cut,
            std::uint32_t internode);

  Distance distance(const Vec3& point) const;
  const Box& bounds() const { return bounds_; }
  std::uint32_t internode() const { return internode_; }  // the skeleton node it belongs to

 private:
  Vec3 base_;
  Vec3 along_ = kUp;
  double length_ = 0.0;  // 0: a ball
  double base_radius_;
  double tip_radius_;
  double sine_ = 0.0;  // of half the cone's opening angle, positive if it narrows
  double cosine_ = 1.0;
  Vec3 cut_;
  Vec3 cut_at_;
  Box bounds_;
  std::uint32_t internode_;
};

/// A place where the cones of two axes blend.
struct Fork {
  Vec3 center{0.0};
  double zone = 0.0;                  // radius of the ball in which they do, metres
  double blend = 0.0;                 // differences of distance below this are smoothed, metres
  std::vector<std::uint32_t> cones;   // of the one axis near the fork
  std::vector<std::uint32_t> others;  // of the other
};

struct WoodField {
  std::vector<RoundCone> cones;
  std::vector<Fork> forks;

  /// The smooth union of both axes; never more than their union's distance.
  double distance(const Fork& fork, const Vec3& point) const;
};

/// Of the internodes for which is_kept is true. `blend` is how wide forks blend, in radii of the lateral's
/// base; 0: not at all. A lateral starts on its parent's axis, as wide as at its first node; at a root the
/// stem is cut off flat, and with it what stands there beside it, if it does not lie. O(n).
WoodField wood_field(const Skeleton& skeleton, const std::vector<bool>& is_kept, double blend);

}  // namespace ramify
