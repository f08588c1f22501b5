// What pictures are drawn into: finer than they come out, for smooth edges.
#pragma once

#include "viewer/gl_objects.h"

namespace ramify {

/// Samples a pixel, each way, in the target; beside these come the samples that OpenGL takes within each.
inline constexpr int kSupersampling = 2;

/// A half-float framebuffer with several samples a pixel, and the means to reduce it to 8 bits.
class RenderTarget {
 public:
  /// For pictures up to width x height. Throws GraphicsError if OpenGL cannot draw into such a target.
  RenderTarget(int width, int height);

  /// Makes the target what is drawn into. It has kSupersampling times the picture's pixels each way.
  void begin();

  /// Reads the lower left width x height pixels as sRGB with straight alpha, bottom row first, into `rgba`.
  void read(int width, int height, unsigned char* rgba);

 private:
  GlRenderbuffer samples_;
  GlRenderbuffer depth_;
  GlFramebuffer sampled_;
  GlTexture resolved_;
  GlFramebuffer resolving_;
  GlTexture finished_;
  GlFramebuffer finishing_;
  GlProgram finish_;
  GlVertexArray no_vertices_;
};

}  // namespace ramify
