// The mesh method "smooth": a tube an axis, with a ring of vertices at each node. Rings are carried along the
// axis by parallel transport, so that tubes do not twist; neighbouring internodes share their ring, so that
// shading is smooth along a branch.
#pragma once

#include "common/mesh/mesh.h"
#include "common/mesh/mesher.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// A lateral's tube starts at its parent's centre line with its own first radius, so no gap shows at a fork;
/// a root's end is closed flat and every tip by a short cone. A skeleton without internodes gives an empty
/// mesh. O(n), on all threads.
Mesh smooth_mesh(const Skeleton& skeleton, const MesherOptions& options);

}  // namespace ramify
