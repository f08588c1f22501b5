// The config inside a file that ramify made.
#pragma once

#include <filesystem>
#include <string>

namespace ramify {

/// True for the endings that can carry a config to make their tree again: .glb, .gltf, .skel.ply.
bool may_embed_config(const std::filesystem::path& path);

/// The config's TOML. Reads no more than a file's header, or the JSON part of glTF, in which nothing but the
/// config is kept. Throws InputError if the file cannot be read, or has no config of ramify.
std::string embedded_config(const std::filesystem::path& path);

}  // namespace ramify
