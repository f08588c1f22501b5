#include "viewer/window.h"

// epoxy stands in for OpenGL's own headers and must come before GLFW's.
#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "common/base/errors.h"
#include "viewer/theme.h"

namespace ramify {
namespace {

// What GLFW said last: it tells why it failed through a callback.
std::string& glfw_problem() {
  static std::string problem;
  return problem;
}

void note_problem(int /*code*/, const char* text) {
  glfw_problem() = text;
  std::replace(glfw_problem().begin(), glfw_problem().end(), '\n', ' ');
}

GraphicsError no_window() {
  return GraphicsError(fmt::format("no window: {} (`ramify render` draws pictures without a display)",
                                   glfw_problem().empty() ? "there is no display" : glfw_problem()));
}

void APIENTRY note_gl_message(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum /*severity*/,
                              GLsizei length, const GLchar* text, const void* errors) {
  if (type != GL_DEBUG_TYPE_ERROR) return;
  auto& lines = *static_cast<std::vector<std::string>*>(const_cast<void*>(errors));
  lines.emplace_back(text, length >= 0 ? static_cast<std::size_t>(length) : std::string(text).size());
}

/// Whether a text field takes it: what writes or moves, and Ctrl with the letters that edit.
bool belongs_to_text(const KeyPress& press) {
  const bool is_character = press.key.size() == 1;
  if (press.with_control && is_character)
    return std::string_view("acvxyz").find(press.key) != std::string_view::npos;
  const bool is_function_key = !is_character && press.key[0] == 'F';
  return !is_function_key;
}

std::string key_name(int key, int scancode) {
  static const std::map<int, std::string> kNamed = {
      {GLFW_KEY_SPACE, "space"}, {GLFW_KEY_ESCAPE, "escape"}, {GLFW_KEY_HOME, "home"},
      {GLFW_KEY_LEFT, "left"},   {GLFW_KEY_RIGHT, "right"},   {GLFW_KEY_KP_1, "1"},
      {GLFW_KEY_KP_3, "3"},      {GLFW_KEY_KP_7, "7"},
  };
  if (const auto named = kNamed.find(key); named != kNamed.end()) return named->second;
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return fmt::format("F{}", key - GLFW_KEY_F1 + 1);
  // By what is printed on it: z is elsewhere on a German keyboard.
  const char* name = glfwGetKeyName(key, scancode);
  return name == nullptr ? "" : name;
}

}  // namespace

struct Window::Implementation {
  GLFWwindow* window = nullptr;
  std::vector<KeyPress> keys;
  std::vector<std::string> dropped;
  double last_input = 0.0;
  std::string device;
  std::string notice;
  std::vector<std::string> gl_errors;
  bool can_be_lost = false;
  double units_per_point = 1.0;  // of a plain display

  void listen();
  void tell_of_errors();
};

void Window::Implementation::listen() {
  glfwSetWindowUserPointer(window, this);
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    auto& self = *static_cast<Implementation*>(glfwGetWindowUserPointer(w));
    self.last_input = now();
    if (action == GLFW_RELEASE) return;
    const std::string name = key_name(key, scancode);
    if (name.empty()) return;
    self.keys.push_back({name, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0});
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int, int, int) {
    static_cast<Implementation*>(glfwGetWindowUserPointer(w))->last_input = now();
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double, double) {
    static_cast<Implementation*>(glfwGetWindowUserPointer(w))->last_input = now();
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double) {
    static_cast<Implementation*>(glfwGetWindowUserPointer(w))->last_input = now();
  });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    auto& self = *static_cast<Implementation*>(glfwGetWindowUserPointer(w));
    for (int index = 0; index < count; ++index) self.dropped.emplace_back(paths[index]);
  });
}

void Window::Implementation::tell_of_errors() {
  if (!epoxy_has_gl_extension("GL_KHR_debug")) return;
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(note_gl_message, &gl_errors);
}

Window::Window(const std::string& title, const Options& options)
    : implementation_(std::make_unique<Implementation>()) {
  glfwSetErrorCallback(note_problem);
  if (!glfwInit()) throw no_window();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.is_debug ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  // A device that is reset says so, where the driver can.
  glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
  GLFWwindow* window = glfwCreateWindow(options.width, options.height, title.c_str(), nullptr, nullptr);
  if (window == nullptr) {
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_NO_ROBUSTNESS);
    window = glfwCreateWindow(options.width, options.height, title.c_str(), nullptr, nullptr);
  }
  if (window == nullptr) {
    glfwTerminate();
    throw no_window();
  }
  implementation_->window = window;
  glfwMakeContextCurrent(window);
  glfwSwapInterval(1);
  if (const GLubyte* name = glGetString(GL_RENDERER)) {
    implementation_->device = reinterpret_cast<const char*>(name);
  }
  implementation_->can_be_lost = epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_ARB_robustness");
  if (options.is_debug) implementation_->tell_of_errors();

  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  implementation_->listen();  // before ImGui, which passes on to it
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  float scale = 1.0f;
  glfwGetWindowContentScale(window, &scale, nullptr);
  const double density = pixels_per_unit();
  implementation_->units_per_point = scale / density;
  implementation_->notice = apply_theme(implementation_->units_per_point, density);
}

Window::~Window() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(implementation_->window);
  glfwTerminate();
}

bool Window::wants_to_close() const {
  return glfwWindowShouldClose(implementation_->window);
}

void Window::close() {
  glfwSetWindowShouldClose(implementation_->window, GLFW_TRUE);
}

bool Window::wait(double seconds) {
  constexpr double kEarly = 0.002;  // seconds: more than clocks are off
  const double start = now();
  if (seconds > 0.0) {
    glfwWaitEventsTimeout(seconds);
  } else {
    glfwPollEvents();
  }
  return now() < start + seconds - kEarly || last_input() >= start;
}

void Window::wake() {
  glfwPostEmptyEvent();
}

void Window::begin_frame() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Window::end_frame() {
  ImGui::Render();
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(implementation_->window, &width, &height);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width, height);
  glClearColor(0.1f, 0.1f, 0.1f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  // ImGui puts back what was in use before it; a tree that was replaced may have taken its program along.
  glUseProgram(0);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(implementation_->window);
  if (implementation_->can_be_lost && glGetGraphicsResetStatusARB() != GL_NO_ERROR) {
    throw GraphicsError("the graphics device was reset: nothing more can be drawn in this window");
  }
}

std::vector<KeyPress> Window::take_keys() {
  std::vector<KeyPress> keys = std::exchange(implementation_->keys, {});
  if (ImGui::GetIO().WantTextInput) std::erase_if(keys, belongs_to_text);
  return keys;
}

std::vector<std::string> Window::take_dropped() {
  return std::exchange(implementation_->dropped, {});
}

double Window::last_input() const {
  return implementation_->last_input;
}

double Window::now() {
  return glfwGetTime();
}

const std::string& Window::device() const {
  return implementation_->device;
}

double Window::pixels_per_unit() const {
  int width = 0;
  int pixels = 0;
  glfwGetWindowSize(implementation_->window, &width, nullptr);
  glfwGetFramebufferSize(implementation_->window, &pixels, nullptr);
  return width > 0 ? static_cast<double>(pixels) / width : 1.0;
}

const std::string& Window::notice() const {
  return implementation_->notice;
}

const std::vector<std::string>& Window::gl_errors() const {
  return implementation_->gl_errors;
}

void Window::set_clipboard(const std::string& text) {
  glfwSetClipboardString(implementation_->window, text.c_str());
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(implementation_->window, title.c_str());
}

void Window::size(int& width, int& height) const {
  glfwGetWindowSize(implementation_->window, &width, &height);
  width = static_cast<int>(std::lround(width / implementation_->units_per_point));
  height = static_cast<int>(std::lround(height / implementation_->units_per_point));
}

}  // namespace ramify
