// The folder of a sweep: its plan, the folders of its runs, and what is gathered from them.
#pragma once

#include <filesystem>
#include <string>

namespace ramify::cli {

/// sweep.json (the plan), runs/NAME/ (run_folder.h), and the results. It grows: finished runs stay, files are
/// replaced one by one, each whole.
class SweepFolder {
 public:
  /// `path` is made if its parent is there; or it is empty or a sweep's. Throws InputError if something else
  /// stands there, IoError if it cannot be written.
  explicit SweepFolder(const std::filesystem::path& path);
  ~SweepFolder();
  SweepFolder(const SweepFolder&) = delete;
  SweepFolder& operator=(const SweepFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path runs() const { return path_ / "runs"; }

  /// Keeps other sweeps of this machine out while this object lives, and removes what was left half-written.
  /// Throws RunError if one is at work there.
  void lock();

  /// Keeps the sweeps of this machine that would lock() out while this object lives, unless one is at work
  /// there; any number may join.
  void join();

  /// Writes a file; `name` is relative and may lie in a sub-folder. Throws IoError.
  void write(const std::filesystem::path& name, const std::string& bytes) const;

 private:
  std::filesystem::path path_;
  int lock_ = -1;  // a file descriptor
};

/// The plan's file in a sweep's folder.
inline constexpr const char* kPlanFile = "sweep.json";

/// The folder of the pictures in a sweep's folder.
inline constexpr const char* kPictures = "pictures";

/// The file there of a run's picture.
inline std::filesystem::path picture_name(const std::string& run) {
  return std::filesystem::path(kPictures) / (run + ".png");
}

}  // namespace ramify::cli
