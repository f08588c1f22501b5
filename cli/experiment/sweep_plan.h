// What a sweep is to make: a run for each combination of values, each with its complete config.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "cli/experiment/value_list.h"
#include "common/config/job.h"

namespace ramify::cli {

struct PlannedRun {
  std::vector<std::string> values;  // one an axis, TOML
  std::string name;                 // of its folder: see RunNames
  std::string config;               // complete, TOML
  int steps = 0;
  /// Runs of one family differ in their steps alone and are cut from one growing tree.
  std::size_t family = 0;
};

struct SweepPlan {
  std::string config;             // as it was given: a preset or a file
  std::string flags;              // --set and others that all runs share, as they would be typed
  std::string command;            // the whole command line
  std::vector<std::string> keys;  // one an axis
  std::vector<PlannedRun> runs;   // the last axis varies soonest
};

/// Most runs of a sweep.
inline constexpr std::size_t kMaxRuns = 10'000;

/// Reads and checks the config with every combination of the axes' values over `overrides`. Throws
/// ConfigError, InputError.
SweepPlan plan_sweep(const EngineRegistry& registry, const std::string& config,
                     std::span<const Override> overrides, std::span<const Axis> axes);

/// Names the folders of runs, kRunNameLength hexadecimal digits: by the digest of ramify's version, the
/// complete config and the files that it names, so that a run is made anew when one of these has changed.
/// Each file is read once.
class RunNames {
 public:
  /// Throws InputError if a file cannot be read.
  std::string of(const Job& job);

 private:
  std::map<std::filesystem::path, std::string> digests_;
};
inline constexpr std::size_t kRunNameLength = 16;

/// The last part of the dotted key `keys[at]`, if no other key ends like it; else all of it.
std::string short_key(const std::vector<std::string>& keys, std::size_t at);

/// Runs that one process makes: of one family, by rising steps.
using Batch = std::vector<std::size_t>;  // indices of SweepPlan::runs

/// `runs` (indices) in batches, those of one name once, in the order of the plan.
std::vector<Batch> batches_of(const SweepPlan& plan, std::span<const std::size_t> runs);

/// Which of `count` slices makes the run, for machines that share a sweep: a family stays together.
inline std::size_t slice_of(const PlannedRun& run, std::size_t count) {
  return run.family % count;
}

/// The plan as a file, for processes that make a part of it or gather the results.
std::string plan_text(const SweepPlan& plan);

/// Whether a text is a plan of any version.
bool is_plan(const std::string& text);

/// Reads what plan_text() wrote; `file` is its name in messages. Throws InputError.
SweepPlan read_plan(const std::string& text, const std::string& file);

}  // namespace ramify::cli
