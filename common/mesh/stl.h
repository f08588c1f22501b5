// Meshes as binary STL, the format of 3D printers.
#pragma once

#include <iosfwd>

#include "common/config/provenance.h"
#include "common/mesh/mesh.h"

namespace ramify {

/// Little-endian; triangles with their own normals, vertices by place alone; metres, +Y up. The header says
/// "ramify VERSION": no more of `provenance` fits. Throws RunError if there are more than 2^32 - 1 triangles.
void write_stl(const Mesh& mesh, const Provenance& provenance, std::ostream& out);

}  // namespace ramify
