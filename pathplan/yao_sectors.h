// The sectors of space around a node that a Yao graph may have.
#pragma once

#include <algorithm>
#include <cstdint>

#include "common/base/geometry.h"
#include "common/base/lanes.h"

namespace ramify::pathplan {

using Sector = std::uint32_t;

/// `condition ? yes : no`, of which the compiler would make a branch.
template <class Unsigned>
Unsigned picked(bool condition, Unsigned yes, Unsigned no) {
  return no ^ ((yes ^ no) & (Unsigned{0} - Unsigned{condition}));
}

// The sector of a rounded difference that may as well belong to another.
inline constexpr Sector kInDoubt = 0xffffffff;

struct Octants {
  static constexpr int kCount = 8;
  static Sector of(const Vec3& d) {
    return Sector{d.x < 0.0} + 2 * Sector{d.y < 0.0} + 4 * Sector{d.z < 0.0};
  }
  /// Of a difference (x, y, z, 0) whose coordinates are off by `error` at most.
  static Sector of_rounded(const Lanes& d, float error) {
    constexpr unsigned kAxes = 7;
    if ((sign_bits(magnitude(d) <= all_lanes(error)) & kAxes) != 0) [[unlikely]]
      return kInDoubt;
    return sign_bits(reinterpret_cast<LaneMask>(d)) & kAxes;
  }
  static Sector opposite(Sector sector) { return 7 - sector; }
  /// On which side of the node the sector lies along an axis: -1, 1, or 0 for both.
  static int side(Sector sector, int axis) { return (sector >> axis & 1) != 0 ? -1 : 1; }
};

/// For sectors whose borders are not planes between axes: each difference is looked at closely.
struct AlwaysInDoubt {
  static Sector of_rounded(const Lanes&, float) { return kInDoubt; }
  static Sector opposite(Sector sector) { return sector; }
};

struct CubeFaces : AlwaysInDoubt {
  static constexpr int kCount = 6;
  static Sector of(const Vec3& d) {
    const Vec3 a = glm::abs(d);
    const bool is_x = (a.x >= a.y) & (a.x >= a.z);
    const bool is_y = a.y >= a.z;
    const Sector along_x{d.x < 0.0};
    const Sector along_y = 2 + Sector{d.y < 0.0};
    const Sector along_z = 4 + Sector{d.z < 0.0};
    return picked(is_x, along_x, picked(is_y, along_y, along_z));
  }
  static int side(Sector sector, int axis) {
    return static_cast<Sector>(axis) != sector / 2 ? 0 : (sector % 2 != 0 ? -1 : 1);
  }
};

/// The directions to a cube's faces, numbered as above, and to its corners, numbered as octants: that which
/// is nearest by angle, a face's if two are.
struct FacesAndCorners : AlwaysInDoubt {
  static constexpr int kCount = CubeFaces::kCount + Octants::kCount;
  static Sector of(const Vec3& d) {
    const Vec3 a = glm::abs(d);
    const double most = std::max({a.x, a.y, a.z});
    const double sum = a.x + a.y + a.z;
    // The cosine to a face is most / |d|, to a corner sum / (sqrt(3) |d|).
    const bool is_corner = sum * sum > 3.0 * most * most;
    return picked<Sector>(is_corner, CubeFaces::kCount + Octants::of(d), CubeFaces::of(d));
  }
  static int side(Sector sector, int axis) {
    return sector < CubeFaces::kCount ? CubeFaces::side(sector, axis)
                                      : Octants::side(sector - CubeFaces::kCount, axis);
  }
};

}  // namespace ramify::pathplan
