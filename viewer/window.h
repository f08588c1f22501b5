// A window with OpenGL and ImGui in it, and what the user does to it.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace ramify {

/// A key that was pressed, by what it writes: "z", "1", or its name: "F12", "space", "delete".
struct KeyPress {
  std::string key;
  bool with_control = false;
  bool with_shift = false;
};

class Window {
 public:
  struct Options {
    int width = 1280;  // pixels of a plain display; a fine one has more
    int height = 800;
    bool is_debug = false;  // OpenGL tells of every error
  };

  /// Opens the window; one at a time in a process. Throws GraphicsError without a display or OpenGL 3.3.
  Window(const std::string& title, const Options& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  bool wants_to_close() const;
  void close();

  /// Sleeps until something happens, wake() is called or so many seconds are over; 0 does not sleep. Whether
  /// something ended it before its time.
  bool wait(double seconds);

  /// From any thread: ends a wait().
  static void wake();

  /// Between these, ImGui's calls make up the window's content; end_frame() shows it. Throws GraphicsError if
  /// the graphics device was lost.
  void begin_frame();
  void end_frame();

  /// What was pressed or dropped since the last call; while text is being written, no keys that it takes.
  std::vector<KeyPress> take_keys();
  std::vector<std::string> take_dropped();

  /// When the newest input came, by now().
  double last_input() const;

  /// Seconds since some moment; the clock of everything in the window.
  static double now();

  /// Who draws, for example "llvmpipe (LLVM 15.0.6, 256 bits)".
  const std::string& device() const;

  /// Pixels of the framebuffer for one of the window's units.
  double pixels_per_unit() const;

  /// A sentence if something about the window is not as it should be, such as a missing font.
  const std::string& notice() const;

  /// What OpenGL complained of in a debug context, one line each.
  const std::vector<std::string>& gl_errors() const;

  void set_clipboard(const std::string& text);
  void set_title(const std::string& title);

  /// Width and height, as in Options.
  void size(int& width, int& height) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace ramify
