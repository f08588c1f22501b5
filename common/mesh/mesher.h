// Skeleton to mesh, by one of several methods; each stands in a file of its own.
#pragma once

#include <string>

#include "common/config/field.h"
#include "common/mesh/mesh.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

enum class MeshMethod { smooth, cones, watertight };

/// Of a watertight mesh: twigs that its voxels cannot resolve.
enum class ThinTwigs { leave_out, tubes };

enum class CentreLine {
  polyline,    // straight between the nodes, with rounded bends
  catmull_rom  // a curve through the nodes
};

struct MesherOptions {
  MeshMethod method = MeshMethod::smooth;
  CentreLine centre_line = CentreLine::polyline;
  int sides_min = 3;          // of the thinnest twigs
  int sides_max = 12;         // of the thickest axis
  double root_flare = 0.8;    // how much wider the trunk is at the ground, of its own radius
  int lod = 0;                // level of detail: each has a third of the triangles of the one before
  int max_triangles = 0;      // 0: as many as it takes
  std::string color_by = {};  // an attribute that the vertices show (attribute_colors.h); empty: none

  // watertight
  double voxel_size = 0.0;  // metres; 0: by the thinnest twig
  double blend = 1.0;       // how wide forks blend, in radii of the lateral's base
  double adaptivity = 0.1;  // how far the surface may move to save triangles, in voxels
  ThinTwigs thin_twigs = ThinTwigs::leave_out;

  static const Table& fields();
};

/// The wood of a tree by options.method. All triangles have the one material "bark"; where vertices have
/// colours it is white. A skeleton without internodes gives an empty mesh. Throws InputError if the skeleton
/// lacks the attribute options.color_by, or if the budget of triangles is too small for it. `memory` is a
/// mesh that is no longer needed: "smooth" writes into its memory, which saves the system handing out new.
Mesh build_mesh(const Skeleton& skeleton, const MesherOptions& options, Mesh memory = {});

}  // namespace ramify
