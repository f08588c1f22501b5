#include "cli/experiment/sweep_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>

#include "cli/experiment/run_folder.h"
#include "cli/experiment/sweep_plan.h"
#include "common/base/errors.h"
#include "common/base/files.h"

namespace ramify::cli {
namespace {

namespace fs = std::filesystem;

IoError cannot_write(const fs::path& path, const std::string& why) {
  return IoError(fmt::format("{}: cannot write: {}", path.string(), why));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directory(folder, error);
  if (error) throw cannot_write(folder, error.message());
}

/// Whether there is nothing in it, or no more than a sweep leaves that is killed before it has written its
/// plan.
bool is_as_new(const fs::path& folder) {
  std::error_code error;
  const auto is_of_new = [&](const fs::path& path) {
    const std::string name = path.filename().string();
    const bool is_half_plan = name.starts_with("." + std::string(kPlanFile) + ".") && name.ends_with(".tmp");
    return is_half_plan || (name == "runs" && fs::is_directory(path, error) && fs::is_empty(path, error));
  };
  const fs::directory_iterator entries(folder, error);
  return !error && std::all_of(begin(entries), end(entries), is_of_new);
}

bool is_of_sweep(const fs::path& folder) {
  std::error_code error;
  if (is_as_new(folder)) return true;
  return fs::is_regular_file(folder / kPlanFile, error) && is_plan(read_file(folder / kPlanFile));
}

/// A file descriptor to lock by; -1 if it cannot be had.
int open_folder(const fs::path& folder) {
  return open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

}  // namespace

SweepFolder::SweepFolder(const fs::path& path) : path_(path) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) {
    require_writable(path);
    make_folder(path);
  } else if (!fs::is_directory(path, error)) {
    throw InputError(fmt::format("{}: is there already and no folder", path.string()));
  } else if (!is_of_sweep(path)) {
    throw InputError(fmt::format("{}: is there already and no folder of `ramify sweep` (name another folder)",
                                 path.string()));
  }
  if (access(path.c_str(), W_OK) != 0) throw cannot_write(path, "the folder is not writable");
  make_folder(runs());
}

SweepFolder::~SweepFolder() {
  if (lock_ >= 0) close(lock_);
}

void SweepFolder::join() {
  lock_ = open_folder(path_);
  static_cast<void>(flock(lock_, LOCK_SH | LOCK_NB));
}

void SweepFolder::lock() {
  lock_ = open_folder(path_);
  if (lock_ < 0 || flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    throw RunError(fmt::format("{}: another `ramify sweep` is at work there", path_.string()));
  }
  remove_leftovers(path_);
  remove_leftovers(runs());
  remove_leftovers(path_ / kPictures);
}

void SweepFolder::write(const fs::path& name, const std::string& bytes) const {
  const fs::path place = path_ / name;
  if (name.has_parent_path()) make_folder(place.parent_path());
  OutputFiles files;
  files.add(place) << bytes;
  files.commit();
}

}  // namespace ramify::cli
