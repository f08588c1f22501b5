// Pictures of trees without a window or a display server.
#pragma once

#include <memory>
#include <string>

#include "common/base/image.h"
#include "viewer/scene.h"

namespace ramify {

class Renderer {
 public:
  /// Makes an off-screen OpenGL context for the calling thread. Throws GraphicsError if there is none.
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// The picture that `options` describe, of the whole scene with a margin or of one place. The same bytes
  /// for the same input on the same device. Throws InputError if options.color_by or options.style asks for
  /// what the scene lacks and GraphicsError if the picture is larger than OpenGL allows. Width and height
  /// must be at least 1.
  Image render(const Scene& scene, const RenderOptions& options);

  /// Who draws: OpenGL's name of the device, for example "llvmpipe (LLVM 15.0.6, 256 bits)".
  std::string device() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace ramify
