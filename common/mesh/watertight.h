// The mesh method "watertight": the wood of a tree as one closed 2-manifold, forks blended, also for 3D
// printing.
#pragma once

#include "common/mesh/mesh.h"
#include "common/mesh/mesher.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// Of level sets that the mesher chooses, or is asked for; a twentieth of a gigabyte of values each million.
inline constexpr double kActiveVoxelsMax = 50e6;

/// Wood thinner than so many voxels would break up: it is left out, with all that grows on it.
inline constexpr double kVoxelsAcross = 2.0;

/// What becomes of a tree, and in voxels of which size.
struct WatertightPlan {
  double voxel_size = 0.0;    // metres
  std::vector<bool> is_kept;  // the internodes that are thick enough
  double predicted_voxels = 0.0;
};

/// The voxel size that options.voxel_size says, or for 0 one that resolves the thinnest twig, coarsened until
/// the level set is predicted to have no more than kActiveVoxelsMax active voxels. Throws InputError if a
/// size that was asked for has more, or is too coarse for the trunk. O(n) for each of some forty sizes tried.
WatertightPlan plan_watertight(const Skeleton& skeleton, const MesherOptions& options);

/// A closed surface around the round cones of the internodes. Twigs that voxels cannot resolve are told in
/// Mesh::warnings; options.thin_twigs says whether they are left out or become closed tubes of their own.
/// A level of detail, or a budget of triangles, makes the voxels coarser, and thin twigs go with them; throws
/// InputError where even the trunk has too many triangles. About 0.4 us a voxel on one thread, and 60 bytes.
/// Vertices are doubled where textures meet (bark_charts.h); all else as in build_mesh().
Mesh watertight_mesh(const Skeleton& skeleton, const MesherOptions& options);

}  // namespace ramify
