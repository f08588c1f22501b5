// Files read whole, and written so that a failure leaves the old file or none.
#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace ramify {

/// The file's bytes. Throws InputError naming the file if it is missing, a folder or unreadable.
std::string read_file(const std::filesystem::path& path);

/// Throws IoError if `path` is a folder, or its folder is missing or does not let us write: said before an
/// engine starts, not after it has run for an hour.
void require_writable(const std::filesystem::path& path);

/// A set of output files that appear together: each is written beside its place and renamed by commit().
/// What is not committed is removed, so a failure or Ctrl-C leaves nothing behind.
class OutputFiles {
 public:
  OutputFiles() = default;
  ~OutputFiles();
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  /// A binary stream for the file that is to stand at `path`. Valid until commit(). Throws IoError, also for
  /// a path that was added before.
  std::ostream& add(const std::filesystem::path& path);

  /// What was added, in that order; empty after commit().
  std::vector<std::filesystem::path> paths() const;

  /// Flushes, closes and looks at every stream, then renames them all into place. Throws IoError.
  void commit();

 private:
  struct Staged {
    std::filesystem::path path;
    std::filesystem::path temporary;
    std::unique_ptr<std::ofstream> stream;
  };
  std::vector<Staged> staged_;
};

}  // namespace ramify
