// A volume made ready for many questions.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/base/geometry.h"

namespace ramify {

struct Volume;
struct Part;

/// A volume with its axes normalized, transforms worked out, files read and unions flattened: parts, each a
/// primitive, a difference or an intersection. Each question costs O(parts). Any number of threads may ask.
class Solid {
 public:
  /// Throws InputError if a sketch or mesh cannot be read; check_volume() says so with the key.
  explicit Solid(const Volume& volume);
  ~Solid();
  Solid(Solid&&) noexcept;
  Solid& operator=(Solid&&) noexcept;

  /// A point on the surface is inside.
  bool contains(const Vec3& point) const;

  /// contains() of each point, 1 or 0, for less than as many calls cost; the spans are as long.
  void find_inside(std::span<const Vec3> points, std::span<std::uint8_t> is_inside) const;

  /// Its sign tells outside from inside, and a point is at least that far from the surface, on either side.
  /// Metres; infinite for a solid without parts.
  double distance_bound(const Vec3& point) const;

  /// True only if the whole solid is farther than `distance` metres from `point`; false where that would take
  /// a closer look. Skips empty space cheaply.
  bool is_farther(const Vec3& point, double distance) const;

  /// Whether the segment touches the solid anywhere; walls thinner than it is long are not jumped. Exact for
  /// primitives but a revolution or mesh. For these, differences and intersections never false where there is
  /// a touch, but true for a near miss, too: nearer than a ten-thousandth of the segment's length or a voxel
  /// of a mesh, times the ratio of the scales in a part that is scaled unevenly.
  bool meets(const Vec3& from, const Vec3& to) const;

  /// The number of a convex part that holds `point`, if there is one. A segment whose ends have the same
  /// number lies inside the volume.
  std::optional<std::uint32_t> convex_part(const Vec3& point) const;

  /// True only if all of a segment whose ends are inside is inside.
  bool is_convex() const;

  /// See outer_depth() in volume.h.
  double outer_depth(const Vec3& point) const;

  /// Tight around every primitive, tilted ones too; around a difference that of its first part, around an
  /// intersection what the parts' boxes share. Empty for a union without parts.
  Box bounds() const;

 private:
  double depth_by_rays(const Vec3& point) const;

  std::vector<Part> parts_;
};

}  // namespace ramify
