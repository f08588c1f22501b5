// A crown made of a few spheres, each joined to the trunk by a cone: clusters of branches with gaps between.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012, 3.3.1,
// Fig. 12.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/volume/solid.h"
#include "common/volume/volume.h"
#include "pathplan/parameters.h"

namespace ramify::pathplan {

/// Number 0 is the trunk, as it is in the level's volume: its first part, or, in one that is no union, where
/// all cones begin; the others are spheres with their cones.
class RefinedCrown {
 public:
  /// Spheres of the given radius at Poisson-disc points of the crown, as far apart as fits. A cone starts on
  /// the trunk's axis where it leaves at about 45 degrees to it, or at `root` without a trunk; it is as wide
  /// as its sphere at the far end and, at the near one, at least 2 spacings of the nodes in radius: less
  /// would cut it off.
  RefinedCrown(const Level& level, const Refinement& refinement, const Vec3& root, std::uint64_t seed);

  /// Trunk, cones and spheres as one.
  const Volume& volume() const { return volume_; }
  std::size_t sphere_count() const { return spheres_.size(); }

  /// Which subvolume a point of the volume belongs to: the trunk if it is in that (without one: as near to
  /// the root as the cones are wide there), else the one whose axis, from the cone's near end to the sphere's
  /// middle, is nearest (of those that hold it; equal ones: the lower number).
  std::uint32_t subvolume_of(const Vec3& point) const;

  /// Where endpoints of a subvolume may be.
  bool is_in_sphere(const Vec3& point, std::uint32_t subvolume) const;

 private:
  struct Sphere {
    Vec3 center;
    double radius;
    Vec3 joint;  // the near end of the cone
    double joint_radius;
  };

  static Volume cone_of(const Sphere& sphere);
  static Volume sphere_of(const Sphere& sphere);
  void join(const Level& level);
  bool is_at_root(const Vec3& point) const;

  bool has_trunk_;
  std::vector<Sphere> spheres_;
  Volume volume_;
  std::vector<Solid> solids_;  // the trunk, if there is one; then sphere and cone of each subvolume
};

}  // namespace ramify::pathplan
