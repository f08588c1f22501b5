// The mesh method "smooth": a tube an axis, swept along a line that bends in arcs. Rings are carried along by
// parallel transport, so that tubes do not twist; neighbouring internodes share their ring, so that shading
// is smooth along a branch.
#pragma once

#include "common/mesh/mesh.h"
#include "common/mesh/mesher.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

struct TubePlan;

/// A lateral's tube begins inside its parent's surface with a collar that flows over into it, but for thin
/// twigs; a trunk's foot flares and is closed flat, tips are rounded or, on twigs, pointed. A collar is its
/// lateral's. A skeleton without internodes gives an empty mesh. O(n), on all threads; no more than the mesh
/// itself and a few bytes a node are held. Throws InputError where the budget of triangles is too small.
/// `memory` is a mesh that is no longer needed and whose memory may be used again.
Mesh smooth_mesh(const Skeleton& skeleton, const MesherOptions& options, Mesh memory = {});

/// The same with a tolerance of one's own: no wood is farther than five times as far from the mesh, metres.
Mesh smooth_mesh(const Skeleton& skeleton, const MesherOptions& options, double tolerance);

/// The mesh of a plan. O(rings), on all threads. `memory` as above.
Mesh sweep(const TubePlan& plan, Mesh memory = {});

}  // namespace ramify
