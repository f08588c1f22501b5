#include "viewer/offscreen_context.h"

#include <dlfcn.h>
// epoxy stands in for both libraries' own headers.
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <vector>

#include "common/base/errors.h"

namespace ramify {
namespace {

std::string egl_error() {
  switch (eglGetError()) {
    case EGL_NOT_INITIALIZED:
      return "EGL could not be initialized";
    case EGL_BAD_ALLOC:
      return "out of resources";
    case EGL_BAD_MATCH:
    case EGL_BAD_CONFIG:
    case EGL_BAD_ATTRIBUTE:
      return "OpenGL 3.3 core is not supported";
    default:
      return "the EGL driver refused";
  }
}

/// epoxy looks for these libraries when it first needs one, and aborts the program if it finds neither.
bool has_opengl_library() {
  return dlopen("libOpenGL.so.0", RTLD_LAZY) != nullptr || dlopen("libGL.so.1", RTLD_LAZY) != nullptr;
}

/// The displays to try, best first. Those that the EGL library does not know are left out.
std::vector<EGLDisplay> candidate_displays() {
  std::vector<EGLDisplay> displays;
  const auto add = [&displays](EGLDisplay display) {
    if (display != EGL_NO_DISPLAY) displays.push_back(display);
  };
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    add(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  }
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
      epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
    for (EGLint device = 0; device < count; ++device) {
      add(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[device], nullptr));
    }
  }
  add(eglGetDisplay(EGL_DEFAULT_DISPLAY));
  return displays;
}

/// EGL_NO_CONTEXT where the display has no OpenGL 3.3 core; eglGetError() then tells why.
EGLContext make_context(EGLDisplay display) {
  if (!eglInitialize(display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
  constexpr std::array<EGLint, 5> kConfig = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                             EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, kConfig.data(), &config, 1, &count) || count == 0) return EGL_NO_CONTEXT;
  constexpr std::array<EGLint, 7> kVersion = {EGL_CONTEXT_MAJOR_VERSION,
                                              3,
                                              EGL_CONTEXT_MINOR_VERSION,
                                              3,
                                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                              EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, kVersion.data());
}

}  // namespace

OffscreenContext::OffscreenContext() {
  // Displays that do not work are passed over: the driver need not complain of each. Does not replace a
  // value.
  setenv("EGL_LOG_LEVEL", "fatal", 0);
  std::string problem = "there is no EGL or OpenGL library";
  if (has_opengl_library() && epoxy_has_egl()) {
    problem = "EGL knows no display";
    for (EGLDisplay display : candidate_displays()) {
      const EGLContext context = make_context(display);
      if (context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        display_ = display;
        context_ = context;
        return;
      }
      problem = egl_error();
      if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    }
  }
  throw GraphicsError(
      fmt::format("no OpenGL 3.3 to draw with: {} (Mesa draws without a graphics card: libegl1, libgl1 and "
                  "libgl1-mesa-dri on Debian)",
                  problem));
}

OffscreenContext::~OffscreenContext() {
  // The display stays initialized: other contexts of this process may be using it.
  if (eglGetCurrentContext() == context_) {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  eglDestroyContext(display_, context_);
}

void OffscreenContext::make_current() {
  if (eglGetCurrentContext() == context_) return;
  if (!eglBindAPI(EGL_OPENGL_API) || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
    throw GraphicsError(fmt::format("cannot use the OpenGL context: {}", egl_error()));
  }
}

std::string OffscreenContext::device() const {
  const GLubyte* name = glGetString(GL_RENDERER);
  return name == nullptr ? "unknown" : reinterpret_cast<const char*>(name);
}

}  // namespace ramify
