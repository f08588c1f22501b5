// Meshes made elsewhere, by the file's ending.
#pragma once

#include <filesystem>

#include "common/mesh/mesh.h"

namespace ramify {

/// A .glb, .gltf or .obj with its materials and their images. Vertices have no internodes. Throws InputError
/// naming the file for one that is missing, unreadable, malformed or of another ending.
Mesh read_mesh(const std::filesystem::path& path);

}  // namespace ramify
