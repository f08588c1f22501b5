#include "cli/experiment/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
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

MemoryFile::MemoryFile(const std::string& text) : file_(memfd_create("stream", MFD_CLOEXEC)) {
  const auto size = static_cast<ssize_t>(text.size());
  if (file_ >= 0 && write(file_, text.data(), text.size()) == size && lseek(file_, 0, SEEK_SET) == 0) return;
  const int error = errno;
  if (file_ >= 0) close(file_);
  throw RunError(fmt::format("cannot write to a file in memory: {}", std::strerror(error)));
}

MemoryFile::~MemoryFile() {
  if (file_ >= 0) close(file_);
}

MemoryFile& MemoryFile::operator=(MemoryFile&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

std::size_t MemoryFile::position() const {
  return static_cast<std::size_t>(lseek(file_, 0, SEEK_CUR));
}

std::size_t MemoryFile::size() const {
  struct stat status {};
  return fstat(file_, &status) == 0 ? static_cast<std::size_t>(status.st_size) : 0;
}

std::string MemoryFile::text() const {
  std::string text(size(), '\0');
  const ssize_t count = pread(file_, text.data(), text.size(), 0);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  return text;
}

std::optional<Process> Process::start(const std::vector<std::string>& arguments, const MemoryFile& input) {
  std::vector<std::string> copies = arguments;
  std::vector<char*> pointers;
  for (std::string& copy : copies) pointers.push_back(copy.data());
  pointers.push_back(nullptr);

  MemoryFile output("");
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail(arguments.front(), errno);
  pid_t child = -1;
  const int failed = SpawnSetting(input.descriptor(), output.descriptor(), ends[1]).spawn(child, pointers);
  close(ends[1]);
  if (failed == 0) return Process(child, std::move(output), ends[0]);
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
      output_(std::move(other.output_)),
      errors_file_(std::exchange(other.errors_file_, -1)),
      errors_(std::move(other.errors_)) {}

Process& Process::operator=(Process&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(output_, other.output_);
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
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), output_.text(),
          std::move(errors_)};
}

void end_with_parent() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
}

std::optional<ProcessEnd> run_process(const std::vector<std::string>& arguments) {
  std::optional<Process> process = Process::start(arguments, MemoryFile(""));
  if (!process) return std::nullopt;
  return process->wait();
}

}  // namespace ramify::cli
