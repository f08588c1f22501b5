// Other programs, started without a shell: no file's name can become a command.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ramify::cli {

/// A file in memory, without a name. What it holds may be far more than a pipe takes.
class MemoryFile {
 public:
  /// Holds `text` and stands at its beginning. Throws RunError if there is no room.
  explicit MemoryFile(const std::string& text);
  ~MemoryFile();
  MemoryFile(MemoryFile&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  MemoryFile& operator=(MemoryFile&& other) noexcept;

  int descriptor() const { return file_; }

  /// Bytes that were read of it, by whoever shares it: programs that it is stdin of read on where another one
  /// stopped.
  std::size_t position() const;

  std::size_t size() const;

  /// All that it holds.
  std::string text() const;

 private:
  int file_;  // -1: moved away
};

/// How a program ended.
struct ProcessEnd {
  int code = 0;        // exit code; 128 + signal if it was killed
  std::string output;  // what it wrote on stdout
  std::string errors;  // and on stderr
};

/// A program that runs beside this one; killed if it still runs when this goes.
class Process {
 public:
  /// Starts a program, found in PATH, with these arguments (its name first). `input` is its stdin; it is a
  /// process group of its own, so that a Ctrl-C is for us to pass on. Nothing if there is no such program.
  /// Throws RunError if it cannot be started.
  static std::optional<Process> start(const std::vector<std::string>& arguments, const MemoryFile& input);
  ~Process();
  Process(Process&& other) noexcept;
  Process& operator=(Process&& other) noexcept;

  pid_t id() const { return id_; }

  /// Readable, for poll(), when it has written on stderr or has ended.
  int errors_file() const { return errors_file_; }

  /// Takes in what it has written on stderr, waiting until there is something; false once it has ended.
  bool read_errors();

  /// Bytes that it has written on stdout so far.
  std::size_t output_size() const { return output_.size(); }

  /// Asks it to end (SIGTERM).
  void stop();

  /// Waits for its end. Once only.
  ProcessEnd wait();

 private:
  Process(pid_t id, MemoryFile output, int errors_file)
      : id_(id), output_(std::move(output)), errors_file_(errors_file) {}

  pid_t id_ = -1;  // -1: waited for, or moved away
  MemoryFile output_;
  int errors_file_ = -1;
  std::string errors_;
};

/// Has this process killed when the one that started it ends, however that comes about.
void end_with_parent();

/// Runs a program as Process::start() does and waits for it. Nothing if there is no such program.
std::optional<ProcessEnd> run_process(const std::vector<std::string>& arguments);

}  // namespace ramify::cli
