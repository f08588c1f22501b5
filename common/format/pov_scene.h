// Skeletons as scenes of the ray tracer POV-Ray: a cone an internode, a sphere a node, as Xu & Mould draw
// them. L. Xu, D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012.
#pragma once

#include <iosfwd>

#include "common/config/provenance.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// A whole scene: the tree on a ground, a camera that sees all of it, two lights and sky; it renders as it
/// is. Metres, right-handed, +Y up, as in all files. An internode without length or width has no cone, a node
/// without width no sphere. `provenance` goes into comments.
void write_pov_scene(const Skeleton& skeleton, const Provenance& provenance, std::ostream& out);

}  // namespace ramify
