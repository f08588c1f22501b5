// Meshes as Wavefront OBJ with its material library.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "common/config/provenance.h"
#include "common/mesh/mesh.h"

namespace ramify {

/// Micrometres, four places of a normal, six of a texture coordinate. `material_library` is the name of the
/// .mtl beside the file; `provenance` goes into comments. The same bytes for any number of threads.
void write_obj(const Mesh& mesh, const Provenance& provenance, const std::string& material_library,
               std::ostream& out);

/// An image beside the .mtl, to be written as PNG.
struct ImageFile {
  std::string name;
  Image image;
};

/// The images that the .mtl refers to: STEM-MATERIAL.png and STEM-MATERIAL-normal.png. OBJ has no colours of
/// vertices: their mean is in the image.
std::vector<ImageFile> image_files(const Mesh& mesh, const std::string& stem);

/// The .mtl: one material each of the mesh's, with map_Kd, norm and, of cutouts, map_d. `stem` as above.
void write_mtl(const Mesh& mesh, const std::string& stem, std::ostream& out);

}  // namespace ramify
