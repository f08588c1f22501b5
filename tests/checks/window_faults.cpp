// What a test cannot do to a window from outside, put under it with LD_PRELOAD. Which of these happen, and
// when, is told by files in the folder that RAMIFY_FAULTS names: "no-fonts", "lost" for a graphics device
// that was reset, and "drop" with the path of a file that is let go over the window. Beside a leak checker
// it keeps all modules loaded, so that their names stand in its report.

#include <dlfcn.h>
// epoxy stands in for OpenGL's own headers and must come before GLFW's.
#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

namespace {

GLFWdropfun drop_callback = nullptr;

std::string fault_file(const std::string& name) {
  const char* folder = std::getenv("RAMIFY_FAULTS");
  return folder == nullptr ? std::string() : std::string(folder) + "/" + name;
}

bool is_asked_for(const std::string& name) {
  return std::ifstream(fault_file(name)).good();
}

GLenum lost_device() {
  return GL_UNKNOWN_CONTEXT_RESET;
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

#if defined(__SANITIZE_ADDRESS__)
int dlclose(void* /*module*/) noexcept {
  return 0;
}
#endif

int stat(const char* path, struct stat* found) noexcept {
  static auto* const real = next<int(const char*, struct stat*)>("stat");
  if (std::string_view(path).ends_with(".ttf") && is_asked_for("no-fonts")) {
    errno = ENOENT;
    return -1;
  }
  return real(path, found);
}

GLFWdropfun glfwSetDropCallback(GLFWwindow* window, GLFWdropfun callback) {
  static auto* const real = next<GLFWdropfun(GLFWwindow*, GLFWdropfun)>("glfwSetDropCallback");
  if (drop_callback == nullptr) drop_callback = callback;
  return real(window, callback);
}

void glfwSwapBuffers(GLFWwindow* window) {
  static auto* const real = next<void(GLFWwindow*)>("glfwSwapBuffers");
  real(window);
  // epoxy calls through pointers.
  if (is_asked_for("lost")) epoxy_glGetGraphicsResetStatusARB = lost_device;
  std::string path;
  if (drop_callback == nullptr || !std::getline(std::ifstream(fault_file("drop")), path)) return;
  std::remove(fault_file("drop").c_str());
  const char* paths[] = {path.c_str()};
  drop_callback(window, 1, paths);
}

}  // extern "C"
