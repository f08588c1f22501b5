#include "cli/experiment/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "common/base/errors.h"

namespace ramify::cli {
namespace {

/// What the child starts with: files for its streams, a group of its own, and signals as they come, for we
/// block some.
class SpawnSetting {
 public:
  SpawnSetting(int input, int output, int errors) {
    posix_spawn_file_actions_init(&files_);
    posix_spawn_file_actions_adddup2(&files_, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files_, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files_, errors, STDERR_FILENO);
    posix_spawnattr_init(&attributes_);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnSetting() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSetting(const SpawnSetting&) = delete;
  SpawnSetting& operator=(const SpawnSetting&) = delete;

  int spawn(pid_t& child, std::vector<char*>& arguments) const {
    return posix_spawnp(&child, arguments.front(), &files_, &attributes_, arguments.data(), environ);
  }

 private:
  posix_spawn_file_actions_t files_;
  posix_spawnattr_t attributes_;
};

/// A file in memory that holds `text`, at its beginning; a pipe would block one side while the other does not
/// look. -1 if there is no room.
int file_with(const std::string& text) {
  const int file = memfd_create("stream", MFD_CLOEXEC);
  if (file < 0) return file;
  const auto size = static_cast<ssize_t>(text.size());
  if (write(file, text.data(), text.size()) == size && lseek(file, 0, SEEK_SET) == 0) return file;
  close(file);
  return -1;
}

/// Appends the next bytes of a file; false at its end.
bool read_on(int file, std::string& text) {
  std::array<char, 4096> buffer;
  ssize_t count = 0;
  do {
    count = read(file, buffer.data(), buffer.size());
  } while (count < 0 && errno == EINTR);
  if (count <= 0) return false;
  text.append(buffer.data(), static_cast<std::size_t>(count));
  return true;
}

[[noreturn]] void fail(const std::string& program, int error) {
  throw RunError(fmt::format("{}: cannot start: {}", program, std::strerror(error)));
}

}  // namespace

std::optional<Process> Process::start(const std::vector<std::string>& arguments, const std::string& input) {
  std::vector<std::string> copies = arguments;
  std::vector<char*> pointers;
  for (std::string& copy : copies) pointers.push_back(copy.data());
  pointers.push_back(nullptr);

  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail(arguments.front(), errno);
  const int input_file = file_with(input);
  const int output_file = file_with("");
  pid_t child = -1;
  const bool has_files = input_file >= 0 && output_file >= 0;
  const int failed =
      has_files ? SpawnSetting(input_file, output_file, ends[1]).spawn(child, pointers) : errno;
  if (input_file >= 0) close(input_file);
  close(ends[1]);
  if (failed == 0) return Process(child, output_file, ends[0]);
  if (output_file >= 0) close(output_file);
  close(ends[0]);
  if (failed == ENOENT) return std::nullopt;
  fail(arguments.front(), failed);
}

Process::~Process() {
  if (id_ > 0) {
    kill(id_, SIGKILL);
    wait();
  }
}

Process::Process(Process&& other) noexcept
    : id_(std::exchange(other.id_, -1)),
      output_file_(std::exchange(other.output_file_, -1)),
      errors_file_(std::exchange(other.errors_file_, -1)),
      errors_(std::move(other.errors_)) {}

Process& Process::operator=(Process&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(output_file_, other.output_file_);
  std::swap(errors_file_, other.errors_file_);
  std::swap(errors_, other.errors_);
  return *this;
}

bool Process::read_errors() {
  return read_on(errors_file_, errors_);
}

void Process::stop() {
  if (id_ > 0) kill(id_, SIGTERM);
}

ProcessEnd Process::wait() {
  while (read_errors()) {
  }
  close(std::exchange(errors_file_, -1));
  int status = 0;
  while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
  }
  id_ = -1;
  std::string output;
  lseek(output_file_, 0, SEEK_SET);
  while (read_on(output_file_, output)) {
  }
  close(std::exchange(output_file_, -1));
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), std::move(output),
          std::move(errors_)};
}

std::optional<ProcessEnd> run_process(const std::vector<std::string>& arguments) {
  std::optional<Process> process = Process::start(arguments);
  if (!process) return std::nullopt;
  return process->wait();
}

}  // namespace ramify::cli
