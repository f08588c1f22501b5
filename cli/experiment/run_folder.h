// What a run of a sweep leaves: a folder of its own, whole or not at all, or a note of why there is none.
// Several processes, on several machines, may make the same run at once: the first one's folder stays.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/geometry.h"
#include "common/config/job.h"

namespace ramify::cli {

/// A finished run.
struct RunRecord {
  std::vector<std::optional<double>> metrics;  // in the order of metric_table()
  double seconds = 0.0;                        // that the engine took
  std::uint64_t peak_memory_bytes = 0;
  Box extent;                         // of the wood, metres
  Box obstacles;                      // around those in its way; empty if there are none
  std::vector<std::string> warnings;  // a limit that it stopped at, for instance
};

/// One of its metrics, by the key of metric_table().
std::optional<double> metric_of(const RunRecord& record, std::string_view key);

/// The names of the files in a run's folder.
inline constexpr const char* kRunConfig = "config.toml";
inline constexpr const char* kRunTree = "tree.skel.ply";
inline constexpr const char* kRunRecord = "result.json";

/// Writes the folder of `job`, whose tree this is, into `runs`. Throws IoError.
void write_run(const std::filesystem::path& runs, const Job& job, const Skeleton& tree, double seconds,
               std::uint64_t peak_memory_bytes, const std::vector<std::string>& warnings);

/// Nothing unless the run of that name and complete config is there.
std::optional<RunRecord> read_run(const std::filesystem::path& runs, const std::string& name,
                                  const std::string& config);

/// Keeps in `runs` why the run of that name failed; a run that is made forgets it.
void write_failure(const std::filesystem::path& runs, const std::string& name, const std::string& message);
std::optional<std::string> read_failure(const std::filesystem::path& runs, const std::string& name);
void forget_failure(const std::filesystem::path& runs, const std::string& name);

/// Removes what killed processes of this machine left half-written. None of its processes may be making runs
/// there; those of others may.
void remove_leftovers(const std::filesystem::path& runs);

}  // namespace ramify::cli
