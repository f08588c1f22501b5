// What came out of a sweep's runs, gathered from their folders.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/experiment/run_folder.h"
#include "cli/experiment/sweep_plan.h"

namespace ramify::cli {

/// One run's row.
struct SweepRow {
  std::optional<RunRecord> record;  // of a finished run
  std::string failure;              // why there is none; empty if it was not made yet
};

/// One row a run of the plan, in its order.
struct SweepResults {
  SweepPlan plan;
  std::vector<SweepRow> rows;

  std::size_t count_done() const;
  std::size_t count_failed() const;
};

/// Reads the folders of the plan's runs.
SweepResults gather(const SweepPlan& plan, const std::filesystem::path& runs);

/// Indices of the runs that are not finished.
std::vector<std::size_t> unfinished(const SweepResults& results);

/// "done", "failed", or "missing" of a run that was not made yet.
std::string status_of(const SweepRow& row);

/// The run's warnings, or why it failed; one line.
std::string message_of(const SweepRow& row);

/// results.csv: a column each for the run's name, the varied keys, the metrics, seconds, peak memory, status
/// and message.
std::string results_csv(const SweepResults& results);

}  // namespace ramify::cli
