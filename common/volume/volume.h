// Solids that hold graphs, envelopes and obstacles: primitives and unions of them, each placed in the world.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/geometry.h"
#include "common/config/field.h"

namespace ramify {

enum class Shape { sphere, ellipsoid, cylinder, cone, hemisphere, sphere_portion, union_of };

/// One recursive description, as it stands in a config. A shape reads the sizes that it needs.
struct Volume {
  Shape shape = Shape::sphere;
  Vec3 center{0.0, 0.0, 0.0};      // of a sphere or ellipsoid; of the base of the others; a portion's apex
  double radius = 1.0;             // sphere, hemisphere, sphere_portion, cylinder; cone: of its base
  double height = 1.0;             // cylinder, cone, along `direction`
  Vec3 radii{1.0, 1.0, 1.0};       // ellipsoid: half axes along x, y, z
  double angle_deg = 60.0;         // sphere_portion: greatest angle from `direction`; 90 is a half ball
  Vec3 direction{0.0, 1.0, 0.0};   // axis of cylinder, cone (base to apex), hemisphere (to its pole), portion
  std::vector<Volume> parts = {};  // union_of

  static const Table& fields();
};

/// A volume made ready for many questions: its axes normalized, nested unions flattened.
/// Each question costs O(parts). Any number of threads may ask.
class Solid {
 public:
  explicit Solid(const Volume& volume);
  ~Solid();
  Solid(Solid&&) noexcept;
  Solid& operator=(Solid&&) noexcept;

  /// A point on the surface is inside.
  bool contains(const Vec3& point) const;

  /// True only if the whole solid is farther than `distance` metres from `point`; false where that would take
  /// a closer look. Skips empty space cheaply.
  bool is_farther(const Vec3& point, double distance) const;

  /// The number of a convex part that holds `point`, if there is one. A segment whose ends have the same
  /// number lies inside the volume.
  std::optional<std::uint32_t> convex_part(const Vec3& point) const;

  /// See outer_depth() below.
  double outer_depth(const Vec3& point) const;

  /// Tight around every part, tilted ones too; empty for a union without parts.
  Box bounds() const;

 private:
  struct Part;
  bool is_covered(const Vec3& point, const Part& own) const;
  double depth_by_rays(const Vec3& point) const;

  std::vector<Part> parts_;
};

/// The same for a single question: prepares the volume each time.
bool contains(const Volume& volume, const Vec3& point);
Box bounds(const Volume& volume);

/// Cubic metres, counted at so many points, evenly spread over the bounding box: the same for the same
/// volume. With 100,000 good to 0.3 % (most often 0.05 %) in 2 ms on one thread; 0 where hardly one of them
/// is inside.
double volume_of(const Volume& volume, int points = 100'000);

/// Cubic metres that two volumes share, counted in the same way over the box that their boxes share.
double shared_volume_of(const Volume& a, const Volume& b, int points = 100'000);

/// How far `point`, inside the volume, is from its outer surface, metres: the curved face of a ball,
/// hemisphere or portion of a sphere, not its flat or conical side; the mantle and the far end of a cylinder;
/// the mantle of a cone; of a union what is left of these after the parts are merged. 0 outside.
/// Exact for one part. In a union exact where the nearest face is free; where another part covers it, the
/// faces are sampled along rays and the depth may be too great by about a tenth of a part's size.
double outer_depth(const Volume& volume, const Vec3& point);

/// Throws ConfigError with the dotted key of what is wrong, `key` being the volume's own: a direction of
/// length 0, a union without parts, a volume that is empty.
void check_volume(const Volume& volume, const std::string& key);

}  // namespace ramify
