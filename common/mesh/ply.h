// Meshes as binary PLY.
#pragma once

#include <iosfwd>

#include "common/config/provenance.h"
#include "common/mesh/mesh.h"

namespace ramify {

/// Little-endian; vertices x y z nx ny nz s t, red green blue alpha where the mesh has colours, internode;
/// faces as lists. `provenance` goes into comments.
void write_ply(const Mesh& mesh, const Provenance& provenance, std::ostream& out);

}  // namespace ramify
