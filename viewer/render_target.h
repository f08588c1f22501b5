// What pictures are drawn into: finer than they come out, for smooth edges.
#pragma once

#include "viewer/gl_objects.h"

namespace ramify {

/// Samples a pixel, each way, in the target; beside these come the samples that OpenGL takes within each.
inline constexpr int kSupersampling = 2;

/// How finely a picture is drawn.
struct Sampling {
  int fineness = kSupersampling;  // pixels drawn for one of the picture, each way: 1 or 2
  int samples = 4;                // within each of these, as far as OpenGL can; 1: no more than itself

  bool operator==(const Sampling&) const = default;
};

/// A half-float framebuffer with several samples a pixel, and the means to reduce it to 8 bits.
class RenderTarget {
 public:
  /// For pictures up to width x height. Throws GraphicsError if OpenGL cannot draw into such a target.
  RenderTarget(int width, int height, Sampling sampling = {});

  const Sampling& sampling() const { return sampling_; }

  /// Makes the target what is drawn into. It has `fineness` times the picture's pixels each way.
  void begin();

  /// Reduces the lower left width x height pixels to sRGB with straight alpha. Leaves its own framebuffer
  /// bound.
  void finish(int width, int height);

  /// Reads the pixels that finish() made, bottom row first, into `rgba`. Leaves its own framebuffer bound.
  void read_finished(int width, int height, unsigned char* rgba) const;

  /// What finish() made, bottom row first.
  const GlTexture& picture() const { return finished_; }

 private:
  Sampling sampling_;
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
