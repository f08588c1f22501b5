// The window in which trees are compared and their parameters tuned by hand. It knows no engine and no file
// format: the program around it hands both in.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "common/config/engine.h"
#include "common/config/job.h"
#include "viewer/document.h"

namespace ramify {

/// What is written to a file.
struct Export {
  const Job& job;
  std::shared_ptr<const RunResult> run;  // with all its history
  const Skeleton& skeleton;              // as it is shown
  std::filesystem::path path;            // its ending says how
};

struct ViewServices {
  const EngineRegistry& registry;
  /// Finds out what a name stands for: a preset or a file. Throws ConfigError or InputError.
  std::function<Opened(const std::string& input)> open;
  /// Writes a file, whole or not at all; not on the window's thread. Throws.
  std::function<void(const Export&)> write;
  std::stop_token stop;  // closes the window
  std::string endings;   // that `write` knows, for people: ".glb .obj"
};

struct ViewOptions {
  std::vector<std::string> inputs;  // at most two
  int width = 1280;
  int height = 800;
  bool is_driven = false;  // by a test: tells where its widgets are (widget_report.h) and checks OpenGL
};

/// Opens the window and returns when it is closed. Throws GraphicsError without a display or OpenGL 3.3, what
/// `open` throws for the inputs, and, where it is driven, RunError for an error of OpenGL's.
void view(const ViewServices& services, const ViewOptions& options);

}  // namespace ramify
