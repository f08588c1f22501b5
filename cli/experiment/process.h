// Other programs, started without a shell: no file's name can become a command.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace ramify::cli {

/// How a program ended.
struct ProcessEnd {
  int code = 0;        // exit code; 128 + signal if it was killed
  std::string output;  // what it wrote on stdout
  std::string errors;  // and on stderr
};

/// A program that runs beside this one; killed if it still runs when this goes.
class Process {
 public:
  /// Starts a program, found in PATH, with these arguments (its name first). Its stdin holds `input`; it
  /// is a process group of its own, so that a Ctrl-C is for us to pass on. Nothing if there is no such
  /// program. Throws RunError if it cannot be started.
  static std::optional<Process> start(const std::vector<std::string>& arguments,
                                      const std::string& input = {});
  ~Process();
  Process(Process&& other) noexcept;
  Process& operator=(Process&& other) noexcept;

  pid_t id() const { return id_; }

  /// Readable, for poll(), when it has written on stderr or has ended.
  int errors_file() const { return errors_file_; }

  /// Takes in what it has written on stderr, waiting until there is something; false once it has ended.
  bool read_errors();

  /// Asks it to end (SIGTERM).
  void stop();

  /// Waits for its end. Once only.
  ProcessEnd wait();

 private:
  Process(pid_t id, int output_file, int errors_file)
      : id_(id), output_file_(output_file), errors_file_(errors_file) {}

  pid_t id_ = -1;  // -1: waited for, or moved away
  int output_file_ = -1;
  int errors_file_ = -1;
  std::string errors_;
};

/// Runs a program as Process::start() does and waits for it. Nothing if there is no such program.
std::optional<ProcessEnd> run_process(const std::vector<std::string>& arguments);

}  // namespace ramify::cli
