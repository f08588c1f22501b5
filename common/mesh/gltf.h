// Meshes as glTF 2.0, the format that game engines, Blender and web viewers share.
// https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
#pragma once

#include <iosfwd>
#include <string>

#include "common/config/provenance.h"
#include "common/mesh/mesh.h"

namespace ramify {

enum class GltfForm { binary, text };  // .glb, or .gltf with its buffer embedded

/// One node with one primitive a material range; metres, +Y up, root at the origin. Images are embedded as
/// PNG, vertex colours as COLOR_0, tangents where the material has a normal map. `provenance` stands in
/// asset.extras.ramify, so that the file can make its tree again, with its metrics. A mesh without triangles
/// gives a node without mesh. The arrays are written as they lie in memory. Throws RunError if the mesh is
/// too large for the format (4 GiB).
void write_gltf(const Mesh& mesh, const Provenance& provenance, GltfForm form, std::ostream& out);

/// The triangles of all meshes of a .glb or .gltf's scene, with materials, images and colours, `bytes` being
/// the file's content and `name` what to call it in messages. Vertices have no internodes. Throws InputError.
Mesh read_gltf(const std::string& bytes, const std::string& name);

}  // namespace ramify
