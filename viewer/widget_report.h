// Tells a program that drives the window by mouse and keys where things are.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace ramify {

/// Lines on standard output: "RECT name x0 y0 x1 y1", pixels of the window, for each widget that is seen, and
/// "GONE name" when it no longer is; only where something changed. Spaces in names become underscores. Does
/// nothing unless it is on.
class WidgetReport {
 public:
  explicit WidgetReport(bool is_on) : is_on_(is_on) {}

  bool is_on() const { return is_on_; }

  /// The ImGui item that was made last.
  void add(std::string_view name);

  /// Any rectangle of the window.
  void add(std::string_view name, float x0, float y0, float x1, float y1);

  /// Ends a frame: prints what changed.
  void flush();

  /// One line of its own, such as "READY".
  void say(const std::string& line) const;

 private:
  bool is_on_;
  std::map<std::string, std::string, std::less<>> shown_;
  std::map<std::string, std::string, std::less<>> next_;
};

}  // namespace ramify
