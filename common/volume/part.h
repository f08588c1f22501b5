// What a solid is made of: a primitive placed in the world, or a difference or intersection of such.
#pragma once

#include <optional>
#include <vector>

#include "common/volume/placement.h"
#include "common/volume/primitive.h"

namespace ramify {

struct Part {
  /// See Primitive::distance_bound(); here of the whole part, in the world. Inside an unevenly scaled part it
  /// may be too small by the ratio of the scales.
  double distance_bound(const Vec3& point) const {
    return is_plain ? primitive.distance_bound(point) : other_bound(point);
  }
  bool contains(const Vec3& point) const { return distance_bound(point) <= kSurfaceSlack; }

  /// Whether some point of the segment is inside. Exact for all primitives but revolutions and meshes. For
  /// the others a near miss counts as a hit: nearer than a ten-thousandth of the segment's length, or than
  /// about a voxel where there is a mesh: no wall is jumped, however thin.
  bool meets(const Vec3& from, const Vec3& to) const;

  /// Adds the nearest point of each outer face to a point inside.
  void add_nearest_faces(const Vec3& point, std::vector<FacePoint>& faces) const;

  Shape shape = Shape::sphere;
  bool is_plain = true;                     // a primitive that lies in the world as it is
  Primitive primitive;                      // a sphere where there are parts
  std::optional<Placement> placement = {};  // of a primitive that is not plain
  std::vector<Part> parts = {};             // of a union within another part, a difference, an intersection
  bool is_convex = false;  // all of a segment whose ends are inside is inside; false if not known
  Box bounds = {};         // of a difference: its first part's
  double tolerance = 0.0;  // the bound may be that high on a wall of a mesh that is lost between voxels

 private:
  double other_bound(const Vec3& point) const;
  bool marches_into(const Vec3& from, const Vec3& to) const;
  FacePoint nearest_seen_from_outside(const Vec3& point) const;
};

/// The parts of a volume, unions resolved. Throws InputError if a file cannot be read.
std::vector<Part> parts_of(const Volume& volume);

/// The nearest faces of those of `parts` that hold the point, but for those that another part covers.
void add_free_faces(const std::vector<Part>& parts, const Vec3& point, std::vector<FacePoint>& faces);

/// Whether a part other than `own` holds the point.
bool is_covered(const std::vector<Part>& parts, const Part& own, const Vec3& point);

// A face is covered where the point this far in front of it is inside another part: parts that only touch
// cover each other's faces, a part does not cover its own. Metres.
constexpr double kFaceStep = 1e-6;

}  // namespace ramify
