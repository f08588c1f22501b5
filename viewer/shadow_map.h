// What the sun sees of the scene.
#pragma once

#include "viewer/gl_objects.h"

namespace ramify {

/// A square depth picture for shadows on the tree itself and, for its soft shadow on the ground, one of
/// coverage and coverage times depth, with coarser and coarser copies (mipmaps).
class ShadowMap {
 public:
  /// `size` pixels a side.
  explicit ShadowMap(int size);

  int size() const { return size_; }

  /// Clears the map and makes it what is drawn into.
  void begin(bool is_cleared = true);

  /// Makes the coarser copies. The caller binds its own framebuffer again.
  void finish();

  const GlTexture& depth() const { return depth_; }
  const GlTexture& coverage() const { return coverage_; }

 private:
  int size_;
  GlTexture depth_;
  GlTexture coverage_;
  GlFramebuffer framebuffer_;
};

}  // namespace ramify
