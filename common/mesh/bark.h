// Bark: which texture the wood has, how often it is repeated around a branch, and how width colours it.
#pragma once

#include <filesystem>

#include "common/config/field.h"
#include "common/mesh/mesh.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

enum class BarkKind {
  plain,   // a colour alone
  ridged,  // long ridges with furrows between them: oak, elm
  smooth,  // hardly rough, with lenticels across the stem: beech, birch, cherry
  plated,  // plates of scales: pine
};

struct BarkOptions {
  BarkKind kind = BarkKind::ridged;
  std::filesystem::path image;   // instead of the made one; empty: none
  std::filesystem::path normal;  // a normal map that goes with `image`
  double tile_width = 0.5;       // metres that the texture is wide on a trunk, at most a third of its girth
  int resolution = 512;          // pixels of a made texture's side

  static const Table& fields();
};

/// Gives the ranges that use the material "bark" their texture, and the wood's vertices a colour each that
/// goes from twigs to trunk. Texture coordinates are scaled so that the texture stands a whole number of
/// times around each axis, at its base about as wide as on the axis that bears it. The skeleton is the one
/// the mesh was made from. Throws InputError for an image that cannot be used. O(n).
void dress_in_bark(Mesh& mesh, const Skeleton& skeleton, const BarkOptions& options);

/// How often the texture stands around the wood at each node: around a trunk as often as fits, around a
/// lateral so that it is as wide as on the wood that bears it, as far as whole numbers go. O(n).
std::vector<float> bark_repeats(const Skeleton& skeleton, double tile_width);

/// Throws ConfigError with the key "image" or "normal" if that file cannot be used.
void check_bark(const BarkOptions& options);

}  // namespace ramify
