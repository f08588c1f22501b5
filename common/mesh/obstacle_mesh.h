// What stands in a tree's way, to be looked at beside it.
#pragma once

#include "common/config/job.h"
#include "common/mesh/mesh.h"

namespace ramify {

/// The surfaces of all obstacles that the job's run uses, in one plain material; empty if there are none.
/// `voxels` as for surface_of(). Throws InputError if a volume's file cannot be read.
Mesh obstacle_mesh(const Job& job, int voxels = 128);

}  // namespace ramify
