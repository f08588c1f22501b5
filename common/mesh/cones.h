// The mesh method "cones": a truncated cone an internode and a sphere a node, as Xu & Mould draw their trees.
// L. Xu, D. Mould, Procedural Tree Modeling with Guiding Vectors, Computer Graphics Forum 31(7), 2012.
#pragma once

#include "common/mesh/mesh.h"
#include "common/mesh/mesher.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// Each cone touches the spheres at its ends, so that no edge shows between them; where one sphere holds the
/// other, there is no cone. Where an axis bends between 8 and 60 degrees, its cones end in the plane of the
/// bend and hide the sphere: of few sides it would stand out as a knuckle. Not where internodes are about as
/// short as they are thick. A lateral's first cone is as wide at its base as at its end. The parts overlap.
/// A skeleton without internodes gives an empty mesh. O(n), on all threads.
Mesh cones_mesh(const Skeleton& skeleton, const MesherOptions& options);

}  // namespace ramify
