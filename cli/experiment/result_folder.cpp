#include "cli/experiment/result_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/config/provenance.h"

namespace ramify::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAbout = "about.json";

/// Relative paths of all files in a folder, but for about.json.
std::set<std::string> files_below(const fs::path& folder) {
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).generic_string();
    if (!entry.is_directory() && name != kAbout) files.insert(name);
  }
  return files;
}

/// Made by `maker`, and it holds nothing that is not named in its about.json.
bool is_own(const fs::path& folder, const std::string& maker) {
  std::error_code error;
  if (!fs::is_regular_file(folder / kAbout, error)) return false;
  const nlohmann::json about = nlohmann::json::parse(read_file(folder / kAbout), nullptr, false);
  if (!about.is_object() || about.value("made_by", nlohmann::json()) != maker) return false;
  const nlohmann::json listed = about.value("files", nlohmann::json::array());
  for (const std::string& file : files_below(folder)) {
    if (std::find(listed.begin(), listed.end(), nlohmann::json(file)) == listed.end()) return false;
  }
  return true;
}

/// `name` is what the user calls the folder at `path`.
void require_own(const fs::path& path, const std::string& name, const std::string& maker) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return;
  if (!fs::is_directory(path, error) || fs::is_symlink(path, error)) {
    throw InputError(fmt::format("{}: is there already and no folder", name));
  }
  if (fs::is_empty(path, error) || is_own(path, maker)) return;
  throw InputError(fmt::format(
      "{}: is there already and holds files that `{}` did not make (name another folder)", name, maker));
}

}  // namespace

ResultFolder::ResultFolder(const fs::path& path, std::string maker) : maker_(std::move(maker)) {
  path_ = fs::absolute(path).lexically_normal();
  if (!path_.has_filename()) path_ = path_.parent_path();  // "out/"
  try {
    require_own(path_, path.string(), maker_);
  } catch (const fs::filesystem_error& error) {
    throw IoError(fmt::format("{}: cannot read: {}", path.string(), error.code().message()));
  }
  const fs::path name = fmt::format(".{}.{}.tmp", path_.filename().string(), getpid());
  std::error_code error;
  if (!fs::is_directory(path_.parent_path(), error)) {
    throw IoError(
        fmt::format("{}: cannot write: there is no folder {}", path.string(), path_.parent_path().string()));
  }
  staging_ = path_.parent_path() / name;
  fs::remove_all(staging_, error);
  if (!fs::create_directory(staging_, error)) {
    throw IoError(fmt::format("{}: cannot write: {}", path.string(), error.message()));
  }
}

ResultFolder::~ResultFolder() {
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
}

void ResultFolder::write(const fs::path& name, const std::string& bytes) {
  std::error_code error;
  fs::create_directories((staging_ / name).parent_path(), error);
  if (error) throw IoError(fmt::format("{}: cannot write: {}", (path_ / name).string(), error.message()));
  OutputFiles files;
  files.add(staging_ / name) << bytes;
  files.commit();
}

void ResultFolder::commit(const std::string& command) {
  const nlohmann::ordered_json about = {
      {"made_by", maker_}, {"version", version()}, {"command", command}, {"files", files_below(staging_)}};
  write(kAbout, about.dump(2) + "\n");
  // The old folder goes aside first: a rename does not replace one that holds files.
  const fs::path old =
      staging_.parent_path() / fmt::format(".{}.{}.old", path_.filename().string(), getpid());
  std::error_code error;
  const bool has_old = fs::exists(path_, error);
  if (has_old) fs::rename(path_, old, error);
  if (!error) fs::rename(staging_, path_, error);
  if (error) {
    std::error_code ignored;
    if (has_old && !fs::exists(path_, ignored)) fs::rename(old, path_, ignored);
    throw IoError(fmt::format("{}: cannot write: {}", path_.string(), error.message()));
  }
  fs::remove_all(old, error);
}

}  // namespace ramify::cli
