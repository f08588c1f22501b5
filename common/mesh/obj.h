// Meshes as Wavefront OBJ with its material library.
#pragma once

#include <iosfwd>
#include <string>

#include "common/config/provenance.h"
#include "common/mesh/mesh.h"

namespace ramify {

/// `material_library` is the name of the .mtl beside the file. `provenance` goes into comments.
void write_obj(const Mesh& mesh, const Provenance& provenance, const std::string& material_library,
               std::ostream& out);

/// The .mtl: one material a range.
void write_mtl(const Mesh& mesh, std::ostream& out);

}  // namespace ramify
