// Skeleton to mesh, by one of several methods; each stands in a file of its own.
#pragma once

#include "common/config/field.h"
#include "common/mesh/mesh.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

enum class MeshMethod { smooth, cones };

struct MesherOptions {
  MeshMethod method = MeshMethod::smooth;
  int sides_min = 4;   // of the thinnest twigs
  int sides_max = 12;  // of the thickest axis

  static const Table& fields();
};

/// The wood of a tree by options.method. All triangles have the one material "bark". A skeleton without
/// internodes gives an empty mesh.
Mesh build_mesh(const Skeleton& skeleton, const MesherOptions& options);

}  // namespace ramify
