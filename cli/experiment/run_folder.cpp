#include "cli/experiment/run_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <nlohmann/json.hpp>

#include "cli/experiment/sweep_plan.h"
#include "common/analysis/metrics.h"
#include "common/analysis/metrics_json.h"
#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/format/skeleton_files.h"
#include "common/volume/volume.h"

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

std::string machine() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// Process ids tell apart only what one machine writes.
fs::path half_folder(const fs::path& runs, const std::string& name) {
  return runs / fmt::format(".{}.{}.{}.tmp", name, machine(), getpid());
}

fs::path failure_file(const fs::path& runs, const std::string& name) {
  return runs / (name + ".failed");
}

/// Of the wood, to twice its width: a foot may flare.
Box extent_of(const Skeleton& tree) {
  Box box;
  for (std::size_t node = 0; node < tree.position.size(); ++node) {
    box.include(tree.position[node] - Vec3(tree.diameter[node]));
    box.include(tree.position[node] + Vec3(tree.diameter[node]));
  }
  return box;
}

Box obstacles_of(const Job& job) {
  Box box;
  for (const Volume* volume : job.engine->volumes(job.parameters.get()).obstacles)
    box.include(bounds(*volume));
  return box;
}

nlohmann::json numbers_of(const Vec3& v) {
  return {v.x, v.y, v.z};
}

nlohmann::json corners_of(const Box& box) {
  return {numbers_of(box.low), numbers_of(box.high)};
}

Vec3 vector_of(const nlohmann::json& numbers) {
  return {numbers.at(0), numbers.at(1), numbers.at(2)};
}

Box box_of(const nlohmann::json& corners) {
  return {vector_of(corners.at(0)), vector_of(corners.at(1))};
}

std::string record_text(const Job& job, const Skeleton& tree, double seconds, std::uint64_t peak_memory_bytes,
                        const std::vector<std::string>& warnings) {
  const Box extent = extent_of(tree);
  nlohmann::ordered_json object = {
      {"version", version()}, {"seconds", seconds},           {"peak_memory_bytes", peak_memory_bytes},
      {"warnings", warnings}, {"extent", corners_of(extent)}, {"metrics", metrics_json(measure(tree))}};
  const Box obstacles = obstacles_of(job);
  if (!obstacles.is_empty()) object["obstacles"] = corners_of(obstacles);
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
  record.extent = box_of(object.at("extent"));
  if (object.contains("obstacles")) record.obstacles = box_of(object.at("obstacles"));
  record.warnings = object.at("warnings").get<std::vector<std::string>>();
  return record;
}

}  // namespace

std::optional<double> metric_of(const RunRecord& record, std::string_view key) {
  for (std::size_t k = 0; k < metric_table().size(); ++k) {
    if (metric_table()[k].key == key) return record.metrics[k];
  }
  return std::nullopt;
}

void write_run(const fs::path& runs, const Job& job, const Skeleton& tree, double seconds,
               std::uint64_t peak_memory_bytes, const std::vector<std::string>& warnings) {
  const std::string config = to_toml(job);
  const std::string name = RunNames().of(job);
  HalfFolder folder(half_folder(runs, name));
  OutputFiles files;
  files.add(folder.path() / kRunConfig) << config;
  write_skeleton(tree, SkeletonForm::ply, provenance_of(job), files.add(folder.path() / kRunTree));
  files.add(folder.path() / kRunRecord) << record_text(job, tree, seconds, peak_memory_bytes, warnings);
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
    const bool is_others = entry.is_directory() && name.find("." + machine() + ".") == std::string::npos;
    if (name.front() == '.' && name.ends_with(".tmp") && !is_others) fs::remove_all(entry.path(), error);
  }
}

}  // namespace ramify::cli
