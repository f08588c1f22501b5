// A single shape in its own frame: what a part of a solid is made of.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "common/base/geometry.h"
#include "common/volume/level_set.h"
#include "common/volume/profile.h"
#include "common/volume/volume.h"

namespace ramify {

// A point on the surface is inside: this much covers the rounding of a tilted axis. Metres.
constexpr double kSurfaceSlack = 1e-9;

/// A place on an outer face and where the face looks there, unit length.
struct FacePoint {
  Vec3 point;
  Vec3 normal;
};

/// Whether the segment and the box have a point in common.
bool box_is_met(const Box& box, const Vec3& from, const Vec3& to);

/// The points of a revolution, or those in its file. Throws InputError.
Sketch sketch_of(const Volume& volume);

/// A sphere, ellipsoid, cylinder, cone, hemisphere, portion of a sphere, box, surface of revolution or mesh,
/// with what its tests need worked out. The transform of the volume is not looked at.
struct Primitive {
  /// Throws InputError if a sketch or mesh cannot be read.
  explicit Primitive(const Volume& volume);

  /// Its sign tells outside from inside, 0 is the surface, and it changes by no more than the way a point
  /// goes: so a point is at least that far from the surface, on either side. Metres. Exact inside a convex
  /// shape but an ellipsoid, and outside one but beside its edges.
  double distance_bound(const Vec3& point) const;

  /// All of a segment whose ends are inside is inside.
  bool is_convex() const;

  /// The greatest dot(towards, point) over its points.
  double furthest(const Vec3& towards) const;

  /// Whether some point of the segment is inside. Exact; not for a revolution or mesh.
  bool meets(const Vec3& from, const Vec3& to) const;
  bool has_exact_meets() const { return shape != Shape::revolution && shape != Shape::mesh; }

  /// Adds the nearest point of each outer face to a point inside.
  void add_nearest_faces(const Vec3& point, std::vector<FacePoint>& faces) const;

  /// How far the outer face is from the centre in the unit direction `ray`, if the ray meets one. None of a
  /// revolution or mesh.
  std::optional<double> face_along(const Vec3& ray) const;

  /// Distance and height of a point, seen from the axis.
  Vec2 beside_axis(const Vec3& point) const;

  Shape shape;
  Vec3 center;
  Vec3 axis;  // unit
  double radius;
  double height;
  Vec3 radii;    // half edges of a box, too
  double angle;  // of a portion, a hemisphere being one; radians
  double cosine;
  double sine;
  std::shared_ptr<const Profile> profile;     // revolution
  std::shared_ptr<const LevelSet> level_set;  // mesh

 private:
  double other_bound(const Vec3& point) const;
};

// Here, so that it disappears into the loops over a solid's parts: path planning asks it millions of times.
inline double Primitive::distance_bound(const Vec3& point) const {
  const Vec3 from = point - center;
  const double square = glm::dot(from, from);
  const double along = glm::dot(from, axis);
  const auto across = [&] { return std::sqrt(std::max(0.0, square - along * along)); };
  switch (shape) {
    case Shape::sphere:
      return std::sqrt(square) - radius;
    case Shape::ellipsoid:
      return (glm::length(from / radii) - 1.0) * std::min({radii.x, radii.y, radii.z});
    case Shape::cylinder:
      return std::max({-along, along - height, across() - radius});
    case Shape::cone:
      return std::max(-along,
                      (radius * along + height * across() - radius * height) / std::hypot(radius, height));
    case Shape::hemisphere:
    case Shape::sphere_portion:
      return std::max(std::sqrt(square) - radius, across() * cosine - along * sine);
    default:
      return other_bound(point);
  }
}

}  // namespace ramify
