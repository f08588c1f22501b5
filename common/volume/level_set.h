// A closed mesh as a field of signed distances: the inside test and the depth of volumes of shape "mesh".
// K. Museth, VDB: High-Resolution Sparse Volumes with Dynamic Topology, ACM Trans. Graph. 32(3), 2013.
#pragma once

#include <filesystem>
#include <memory>

#include "common/base/geometry.h"
#include "common/volume/closed_mesh.h"

namespace ramify {

/// Between voxels the distance is interpolated: the surface keeps to the mesh within about a voxel where that
/// has sharp edges, much closer where it is smooth. Walls thinner than two voxels may be lost. A hollow that
/// is closed off all around is filled. Any number of threads may ask.
class LevelSet {
 public:
  /// `voxel_size` in metres; 0 chooses one. Throws InputError if the mesh would be too many voxels long.
  /// Half a second for 40,000 triangles at the chosen size; the same for any number of threads.
  LevelSet(const ClosedMesh& mesh, double voxel_size);
  ~LevelSet();
  LevelSet(const LevelSet&) = delete;
  LevelSet& operator=(const LevelSet&) = delete;

  /// Metres to the surface, negative inside; no more than three voxels either way. Eight voxels are read.
  double signed_distance(const Vec3& point) const;

  /// How far a point inside is from the surface, metres; within a twentieth of the mesh's length where that
  /// is more than three voxels.
  double depth(const Vec3& point) const;

  /// A safe step: signed_distance() may be so many times the distance to the interpolated surface.
  static constexpr double kSteepness = 1.7320508075688772;

  const Box& bounds() const { return bounds_; }
  double voxel_size() const { return voxel_size_; }

 private:
  struct Grids;
  std::unique_ptr<const Grids> grids_;
  Box bounds_;  // of the mesh
  double voxel_size_;
};

/// The level set of an OBJ file. The last few are kept for those who ask again; a file that has changed is
/// read again. Throws InputError, see read_closed_mesh().
std::shared_ptr<const LevelSet> level_set_of(const std::filesystem::path& file, double voxel_size);

}  // namespace ramify
