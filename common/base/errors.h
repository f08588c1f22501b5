// What can go wrong by the user's doing or the machine's. Only main() turns these into exit codes; our own
// mistakes are asserts.
#pragma once

#include <stdexcept>
#include <string>

namespace ramify {

/// A config says something that cannot be. The message reads `where: key: problem`; exit code 2.
class ConfigError : public std::runtime_error {
 public:
  /// `where` is FILE:LINE, "--set" or empty while it is not known; `key` is dotted, or empty.
  ConfigError(std::string where, std::string key, std::string problem)
      : std::runtime_error((where.empty() ? "" : where + ": ") + (key.empty() ? "" : key + ": ") + problem),
        where_(std::move(where)),
        key_(std::move(key)),
        problem_(std::move(problem)) {}

  const std::string& where() const { return where_; }
  const std::string& key() const { return key_; }
  const std::string& problem() const { return problem_; }

 private:
  std::string where_;
  std::string key_;
  std::string problem_;
};

/// An input file cannot be used: missing, unreadable, malformed; or a flag asks for what cannot be. Exit
/// code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A run failed: what was asked for is sound, but this tree or this machine does not allow it. Exit code 1.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An output could not be written. Exit code 1.
class IoError : public RunError {
 public:
  using RunError::RunError;
};

/// No OpenGL to draw with. Exit code 1.
class GraphicsError : public RunError {
 public:
  using RunError::RunError;
};

}  // namespace ramify
