// Solids that hold graphs, envelopes and obstacles: primitives, meshes, and unions, differences and
// intersections of them, each placed in the world.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/geometry.h"
#include "common/config/field.h"
#include "common/volume/solid.h"

namespace ramify {

enum class Shape {
  sphere,
  ellipsoid,
  cylinder,
  cone,
  hemisphere,
  sphere_portion,
  box,
  revolution,
  mesh,
  union_of,
  difference,
  intersection
};

/// One recursive description, as it stands in a config. A shape reads the sizes that it needs; all are then
/// scaled, turned and moved, in that order and seen from the origin, together with the parts they are made
/// of.
struct Volume {
  Shape shape = Shape::sphere;
  Vec3 center{0.0, 0.0, 0.0};  // of a sphere, ellipsoid or box; of the base of the others; a portion's apex
  double radius = 1.0;         // sphere, hemisphere, sphere_portion, cylinder; cone: of its base
  double height = 1.0;         // cylinder, cone, along `direction`
  Vec3 radii{1.0, 1.0, 1.0};   // ellipsoid: half axes along x, y, z
  Vec3 size{1.0, 1.0, 1.0};    // box: edges along x, y, z
  double angle_deg = 60.0;     // sphere_portion: greatest angle from `direction`; 90 is a half ball
  Vec3 direction{0.0, 1.0, 0.0};  // axis of cylinder, cone (base to apex), hemisphere (to its pole), portion
  Sketch points = {};             // revolution: (radius, height) about `direction`, height 0 at the centre
  std::filesystem::path file = {};  // mesh: OBJ; revolution: CSV in place of points
  double voxel_size = 0.0;          // mesh; 0 is chosen from its size
  Vec3 scale{1.0, 1.0, 1.0};        // each more than 0
  Vec3 rotate{0.0, 0.0, 0.0};       // degrees about x, then y, then z
  Vec3 translate{0.0, 0.0, 0.0};
  std::vector<Volume> parts = {};  // union_of, intersection; difference: the first without the others

  static const Table& fields();
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
/// the mantle of a cone; all of a revolution but a flat bottom; all faces of a box or mesh; of a difference
/// what is left of its first part's, and the cuts; of an intersection those of all its parts; of a union what
/// is left of these after the parts are merged. 0 outside.
/// Exact for one part, but that of a mesh follows the grid and that of a part scaled unevenly is exact only
/// near its surface; an ellipsoid cut off makes it too small. In a union exact where the nearest face is
/// free; where another part covers it, the faces are sampled along rays and the depth may be too great by
/// about a tenth of a part's size, or, where no face can be sampled, too small.
double outer_depth(const Volume& volume, const Vec3& point);

/// Throws ConfigError with the dotted key of what is wrong, `key` being the volume's own: a direction of
/// length 0, a union without parts, a sketch or mesh that cannot be used, a volume that is empty. Returns its
/// cubic metres, as volume_of().
double check_volume(const Volume& volume, const std::string& key);

}  // namespace ramify
