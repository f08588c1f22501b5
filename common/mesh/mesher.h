// Skeleton to mesh: a tube an axis, with a ring of vertices at each node. Rings are carried along the axis by
// parallel transport, so that tubes do not twist; neighbouring internodes share their ring, so that shading
// is smooth along a branch.
#pragma once

#include "common/config/field.h"
#include "common/mesh/mesh.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

enum class MeshMethod { smooth };

struct MesherOptions {
  MeshMethod method = MeshMethod::smooth;
  int sides_min = 4;   // of the thinnest twigs
  int sides_max = 12;  // of the thickest axis

  static const Table& fields();
};

/// A lateral's tube starts at its parent's centre line with its own first radius, so no gap shows at a fork;
/// a root's end is closed flat and every tip by a short cone. All triangles have the one material "bark". A
/// skeleton without internodes gives an empty mesh. O(n), on all threads.
Mesh build_mesh(const Skeleton& skeleton, const MesherOptions& options);

}  // namespace ramify
