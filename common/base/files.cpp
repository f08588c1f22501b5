#include "common/base/files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <sstream>
#include <system_error>

#include "common/base/errors.h"

namespace ramify {
namespace {

namespace fs = std::filesystem;

std::string system_message() {
  return errno != 0 ? std::strerror(errno) : "write failed";
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

}  // namespace

std::string read_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error))
    throw InputError(fmt::format("{}: is a folder, not a file", path.string()));
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("{}: cannot read: {}", path.string(), system_message()));
  std::ostringstream text;
  text << file.rdbuf();
  if (file.bad()) throw InputError(fmt::format("{}: cannot read: {}", path.string(), system_message()));
  return std::move(text).str();
}

void require_writable(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw IoError(fmt::format("{}: is a folder, not a file", path.string()));
  const fs::path folder = folder_of(path);
  if (!fs::is_directory(folder, error)) {
    throw IoError(fmt::format("{}: cannot write: there is no folder {}", path.string(), folder.string()));
  }
  if (access(folder.c_str(), W_OK) != 0) {
    throw IoError(fmt::format("{}: cannot write: {}", path.string(), system_message()));
  }
}

OutputFiles::~OutputFiles() {
  for (Staged& file : staged_) {
    file.stream.reset();
    std::error_code ignored;
    fs::remove(file.temporary, ignored);
  }
}

std::ostream& OutputFiles::add(const fs::path& path) {
  require_writable(path);
  for (const Staged& file : staged_) {
    if (file.path.lexically_normal() == path.lexically_normal()) {
      throw IoError(fmt::format("{}: two outputs would write this file", path.string()));
    }
  }
  // In the same folder, so that the rename cannot cross file systems; the process id keeps two runs apart.
  const fs::path temporary = folder_of(path) / fmt::format(".{}.{}.tmp", path.filename().string(), getpid());
  errno = 0;
  auto stream = std::make_unique<std::ofstream>(temporary, std::ios::binary | std::ios::trunc);
  if (!*stream) throw IoError(fmt::format("{}: cannot write: {}", path.string(), system_message()));
  staged_.push_back({path, temporary, std::move(stream)});
  return *staged_.back().stream;
}

std::vector<fs::path> OutputFiles::paths() const {
  std::vector<fs::path> result;
  for (const Staged& file : staged_) result.push_back(file.path);
  return result;
}

void OutputFiles::commit() {
  for (Staged& file : staged_) {
    errno = 0;
    file.stream->close();  // flushes; sets failbit when that does not succeed
    if (!*file.stream)
      throw IoError(fmt::format("{}: cannot write: {}", file.path.string(), system_message()));
  }
  for (Staged& file : staged_) {
    std::error_code error;
    fs::rename(file.temporary, file.path, error);
    if (error) throw IoError(fmt::format("{}: cannot write: {}", file.path.string(), error.message()));
  }
  staged_.clear();
}

}  // namespace ramify
