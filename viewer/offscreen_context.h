// An OpenGL context that needs no window and no display server.
#pragma once

#include <string>

namespace ramify {

/// OpenGL 3.3 core through EGL, on the first of these that works: Mesa without a surface, a graphics device
/// by itself, the default display. Current on the thread that made it. Throws GraphicsError if there is none.
class OffscreenContext {
 public:
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// Makes OpenGL calls of this thread go to this context. Throws GraphicsError.
  void make_current();

  /// Who draws, for example "llvmpipe (LLVM 15.0.6, 256 bits)".
  std::string device() const;

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace ramify
