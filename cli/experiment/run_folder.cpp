#include "cli/experiment/run_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "cli/experiment/sweep_plan.h"
#include "common/analysis/metrics.h"
#include "common/analysis/metrics_json.h"
#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/format/skeleton_files.h"

namespace ramify::cli {
namespace {

namespace fs = std::filesystem;

/// A folder that is removed unless it was renamed.
class HalfFolder {
 public:
  explicit HalfFolder(fs::path path) : path_(std::move(path)) {
    std::error_code error;
    fs::remove_all(path_, error);
    if (!fs::create_directory(path_, error)) throw failure(error);
  }
  ~HalfFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  HalfFolder(const HalfFolder&) = delete;
  HalfFolder& operator=(const HalfFolder&) = delete;

  const fs::path& path() const { return path_; }

  /// Leaves a folder that is there already: it has the same content.
  void rename_to(const fs::path& place) {
    std::error_code error;
    fs::rename(path_, place, error);
    if (error && !fs::is_directory(place)) throw failure(error);
  }

 private:
  IoError failure(const std::error_code& error) const {
    return IoError(fmt::format("{}: cannot write: {}", path_.string(), error.message()));
  }

  fs::path path_;
};

fs::path failure_file(const fs::path& runs, const std::string& name) {
  return runs / (name + ".failed");
}

std::string record_text(const Skeleton& tree, double seconds, std::uint64_t peak_memory_bytes,
                        const std::vector<std::string>& warnings) {
  const nlohmann::ordered_json object = {{"version", version()},
                                         {"seconds", seconds},
                                         {"peak_memory_bytes", peak_memory_bytes},
                                         {"warnings", warnings},
                                         {"metrics", metrics_json(measure(tree))}};
  return object.dump(1) + "\n";
}

RunRecord record_of(const nlohmann::json& object) {
  RunRecord record;
  for (const MetricInfo& info : metric_table()) {
    const nlohmann::json& value = object.at("metrics").at(std::string(info.key));
    record.metrics.push_back(value.is_null() ? std::nullopt : std::optional<double>(value.get<double>()));
  }
  record.seconds = object.at("seconds");
  record.peak_memory_bytes = object.at("peak_memory_bytes");
  record.warnings = object.at("warnings").get<std::vector<std::string>>();
  return record;
}

}  // namespace

void write_run(const fs::path& runs, const Job& job, const Skeleton& tree, double seconds,
               std::uint64_t peak_memory_bytes, const std::vector<std::string>& warnings) {
  const std::string config = to_toml(job);
  const std::string name = run_name(config);
  HalfFolder folder(runs / fmt::format(".{}.{}.tmp", name, getpid()));
  OutputFiles files;
  files.add(folder.path() / kRunConfig) << config;
  write_skeleton(tree, SkeletonForm::ply, provenance_of(job), files.add(folder.path() / kRunTree));
  files.add(folder.path() / kRunRecord) << record_text(tree, seconds, peak_memory_bytes, warnings);
  files.commit();
  folder.rename_to(runs / name);
  forget_failure(runs, name);
}

std::optional<RunRecord> read_run(const fs::path& runs, const std::string& name, const std::string& config) {
  const fs::path folder = runs / name;
  std::error_code error;
  if (!fs::is_directory(folder, error)) return std::nullopt;
  try {
    if (read_file(folder / kRunConfig) != config) return std::nullopt;
    return record_of(nlohmann::json::parse(read_file(folder / kRunRecord)));
  } catch (const std::exception&) {  // somebody has taken files away or changed them
    return std::nullopt;
  }
}

void write_failure(const fs::path& runs, const std::string& name, const std::string& message) {
  OutputFiles files;
  files.add(failure_file(runs, name)) << message << '\n';
  files.commit();
}

std::optional<std::string> read_failure(const fs::path& runs, const std::string& name) {
  std::error_code error;
  if (!fs::exists(failure_file(runs, name), error)) return std::nullopt;
  std::string message = read_file(failure_file(runs, name));
  return message.substr(0, message.find('\n'));
}

void forget_failure(const fs::path& runs, const std::string& name) {
  std::error_code ignored;
  fs::remove(failure_file(runs, name), ignored);
}

void remove_leftovers(const fs::path& runs) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(runs, error)) {
    const std::string name = entry.path().filename().string();
    if (name.front() == '.' && name.ends_with(".tmp")) fs::remove_all(entry.path(), error);
  }
}

}  // namespace ramify::cli
