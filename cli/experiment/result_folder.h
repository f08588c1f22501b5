// A folder of results that appears whole or not at all.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace ramify::cli {

/// Written beside its place and renamed by commit(); what is not committed is removed. It may take the place
/// of an empty folder, or of one that the same command made before and nobody has put anything into since.
class ResultFolder {
 public:
  /// `maker` names the command, "ramify compare". Throws InputError if something else stands at `path`,
  /// IoError if the folder cannot be made there.
  ResultFolder(const std::filesystem::path& path, std::string maker);
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  /// Writes a file; `name` is relative and may lie in a sub-folder. Throws IoError.
  void write(const std::filesystem::path& name, const std::string& bytes);

  /// Where other programs may write before commit(); what they leave belongs to the results.
  const std::filesystem::path& staging() const { return staging_; }

  /// Writes about.json, by which the folder is known again, and puts all in place; `command` is the command
  /// line that made it. Throws IoError.
  void commit(const std::string& command);

 private:
  std::filesystem::path path_;
  std::filesystem::path staging_;
  std::string maker_;
};

}  // namespace ramify::cli
