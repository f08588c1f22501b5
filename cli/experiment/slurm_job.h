// A sweep on a cluster: an array job of Slurm (https://slurm.schedmd.com), a task a slice of the runs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "cli/experiment/sweep_plan.h"
#include "cli/experiment/sweep_results.h"

namespace ramify::cli {

struct SlurmOptions {
  int tasks = 0;               // slices; 0: as many as there are families of runs, at most kUsualTasks
  int threads = 0;             // processors of a task; 0: one
  std::string sbatch_options;  // for an #SBATCH line, as they would be typed
};

/// Tasks of a job where nobody says how many: each waits in the cluster's queue for its turn.
inline constexpr std::size_t kUsualTasks = 16;

/// A job that Slurm has taken.
struct SlurmJob {
  std::string id;
  std::size_t slices = 0;        // that the plan's runs are dealt out to
  std::size_t tasks = 0;         // slices that had runs to make
  std::filesystem::path folder;  // plan.json, job.sh, job.json; task-K.log of each task
};

/// Writes the job of these runs (indices, at least one) below the sweep's folder, into a place that is the
/// same for the same plan, and hands it to sbatch. The
/// sweep's folder must be one that all machines share. Throws RunError if there is no sbatch or it fails,
/// with its words; IoError.
SlurmJob submit(const SweepPlan& plan, std::span<const std::size_t> runs, const std::filesystem::path& sweep,
                const SlurmOptions& options);

/// A line about runs that are missing, at least one: how many, of which tasks of the last job that was
/// submitted, if there was one, and how they can be had.
std::string missing_text(const SweepResults& results, const std::filesystem::path& sweep);

}  // namespace ramify::cli
