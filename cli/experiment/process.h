// Other programs, started without a shell: no file's name can become a command.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ramify::cli {

/// How a program ended.
struct ProcessEnd {
  int code = 0;        // exit code; 128 + signal if it was killed
  std::string errors;  // what it wrote on stderr
};

/// Runs a program, found in PATH, with these arguments (its name first) and waits for it; nothing to read on
/// its stdin, its stdout goes nowhere. Nothing if there is no such program. Throws RunError if it cannot be
/// started.
std::optional<ProcessEnd> run_process(const std::vector<std::string>& arguments);

}  // namespace ramify::cli
