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

/// The hull of two balls.
struct RoundCone {
  Vec3 base{0.0};
  Vec3 along = kUp;     // unit
  double length = 0.0;  // metres; 0: a ball
  double base_radius = 0.0;
  double sine = 0.0;  // of half the opening angle, positive if it narrows
  double cosine = 1.0;
  Vec3 cut{0.0};  // what lies behind the plane through cut_at with this normal is cut off; 0: nothing
  Vec3 cut_at{0.0};
  Box bounds;
  std::uint32_t internode = 0;  // the skeleton node it belongs to

  double distance(const Vec3& point) const;
};

/// Where one ball holds the other, that is all.
RoundCone round_cone(const Vec3& base, double base_radius, const Vec3& tip, double tip_radius);

/// How far a blend moves the surface at most, in parts of its width.
inline constexpr double kBlendDepth = 0.25;

/// A place where straight parts of two axes blend.
struct ForkBlend {
  Vec3 center{0.0};
  double zone = 0.0;                  // radius of the ball in which they do, metres
  double width = 0.0;                 // differences of distance below this are smoothed, metres
  std::vector<std::uint32_t> cones;   // of the one part, near the fork
  std::vector<std::uint32_t> others;  // of the other
  Vec3 cut{0.0};                      // as of a cone: the blend must not fill what was cut off there
  Vec3 cut_at{0.0};
};

/// Distances to the wood's surface, metres, negative inside: the least of all cones', and less where forks
/// blend. leaf_field.h says how they are computed.
struct WoodField {
  std::vector<RoundCone> cones;
  std::vector<ForkBlend> forks;
};

/// Of the internodes for which is_kept is true. `blend` is how wide forks blend, in radii of the lateral's
/// base; 0: not at all. A lateral starts on its parent's axis, as wide as at its first node; at a root
/// the stem is cut off level with the ground, and with it what stands there beside it or bulges below. O(n).
WoodField wood_field(const Skeleton& skeleton, const std::vector<bool>& is_kept, double blend);

}  // namespace ramify
