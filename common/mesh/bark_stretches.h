// How a texture lies about an axis by the place alone: the axis is parted into straight stretches, so that
// bark runs on through bends, whatever the surface is made of.
#pragma once

#include <cstdint>
#include <vector>

#include "common/base/geometry.h"
#include "common/mesh/axes.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

class BarkStretches {
 public:
  /// Of all axes. O(n).
  explicit BarkStretches(const Skeleton& skeleton);

  /// Of a point near an internode, or a root: u, once around from -1/2 to 1/2, and v, along, in girths.
  Vec2f uv(std::uint32_t internode, const Vec3& at) const;

 private:
  /// How the texture lies on a straight part of an axis.
  struct Stretch {
    Vec3 base;
    Vec3 tip;
    Vec3 along = kUp;
    Vec3 side{1, 0, 0};     // perpendicular to it; u is 0 there
    Vec3 base_plane = kUp;  // normals of the planes in which it meets its neighbours of the axis
    Vec3 tip_plane = kUp;
    double start = 0.0;  // v at the base and at the tip
    double end = 0.0;
    bool is_first = true;  // of its axis
    bool is_last = true;
  };

  void add(const Axes& axes, const Axis& axis);

  /// Frames are carried along each axis, so that neither u nor v jumps from one stretch to the next.
  void add(const AxisPoint& from, const AxisPoint& to, bool goes_on);

  /// The stretch between whose planes a point lies, looked for from one that is near on its axis.
  const Stretch& stretch_at(const Vec3& at, std::size_t index) const;

  std::vector<Stretch> list_;  // of all axes, one after the other
  std::vector<std::uint32_t> of_internode_;
};

}  // namespace ramify
