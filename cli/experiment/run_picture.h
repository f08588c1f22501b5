// Pictures of runs for a sweep's report.
#pragma once

#include <filesystem>
#include <string>

#include "cli/commands.h"
#include "common/base/geometry.h"
#include "viewer/renderer.h"

namespace ramify::cli {

/// What all pictures of a sweep have in common: how they are to be compared.
struct PictureFrame {
  Box room;      // of the wood of all trees, and of obstacles near them, metres
  int side = 0;  // width and height, pixels
};

/// Draws trees from the folders of their runs.
class Studio {
 public:
  /// Throws GraphicsError if there is nothing to draw with.
  explicit Studio(const PictureFrame& frame) : frame_(frame) {}

  /// The PNG of one. Throws GraphicsError, InputError.
  std::string draw(const std::filesystem::path& run, const EngineRegistry& registry);

 private:
  PictureFrame frame_;
  Renderer renderer_;
};

}  // namespace ramify::cli
