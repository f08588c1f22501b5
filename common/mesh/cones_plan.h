// What a mesh of cones is made of, before anything of it is written: how the cone and the sphere of each node
// lie, how many sides they have and where they go in the mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/geometry.h"
#include "common/mesh/mesher.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

// Of the length of a cone: its bark is squeezed or stretched no more than that by the bends at its ends.
constexpr double kLeastBark = 0.5;

/// How the parts of one node lie: its sphere, and the cone from its parent.
struct NodePart {
  Vec3 along;      // unit, of the internode
  Vec3 side;       // unit, perpendicular to it: where u is 0
  Vec3 bend;       // unit, of the axis at the node: halfway from this internode's direction to the next one's
  Vec3 base_bend;  // the same where the cone begins; a lateral's begins straight
  double v = 0.0;
  double radius = 0.0;         // of the cone where it ends
  double sphere_radius = 0.0;  // the same, or less where the sphere is hidden
  double base_radius = 0.0;    // of the cone
  double sine = 0.0;           // of its taper: radius that it loses along its side
  // Cones that follow one another touch the sphere between them in two circles, and meet at a height between
  // these: above the node, along the axis, metres.
  double base_meeting = 0.0;
  double end_meeting = 0.0;
  // Along the axis, metres, that a cone is longer to meet there, where else the sphere would be seen.
  double base_gap = 0.0;
  double end_gap = 0.0;
  // Angle by which normals lean towards the tip, at both ends of the cone: those of its sides, but where
  // cones of different taper meet halfway between both, so that no edge shows.
  double base_lean = 0.0;
  double end_lean = 0.0;
  // Whether the cone ends in the plane of the bend there, in the same polygon as the next one begins: no
  // sphere is to be seen.
  bool base_is_cut = false;
  bool end_is_cut = false;
  bool has_cone = false;
  bool has_sphere = false;
  bool is_tip = false;           // the axis ends here
  bool winds = false;            // so does the axis: the bends at the ends of some cone reach into each other
  std::uint32_t bands = 1;       // of the cone, one above the other
  std::uint32_t root = 0;        // of the tree
  std::uint32_t axis_sides = 0;  // of the axis at its base, as thick axes have them
  std::uint32_t sides = 0;       // of the cone: as many, more where the axis winds, or less on coarse levels
  std::uint32_t sphere_sides = 0;  // as many, or twice where the axis bends
  std::size_t first_vertex = 0;
  std::size_t first_triangle = 0;

  /// Of the sphere, its poles not counted: its facets are about square, and the middle one is where the cone
  /// ends, so that no edge of that stands out.
  std::uint32_t latitudes() const;
};

struct ConesPlan {
  std::vector<NodePart> parts;
  std::vector<bool> has_roots;  // of each tree; without, it stands flat on the ground
  bool has_winding = false;     // some axis
  std::size_t vertex_count = 0;
  std::size_t triangle_count = 0;
};

/// Frames are carried along each axis, so that bark does not turn from one cone to the next. Where the
/// options allow fewer triangles, axes that do not reach far are left out, like small spheres. The skeleton
/// has internodes. O(n).
ConesPlan plan_cones(const Skeleton& skeleton, const MesherOptions& options);

}  // namespace ramify
