// The runs of a sweep, made by child processes.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "cli/experiment/process_pool.h"
#include "cli/experiment/sweep_plan.h"

namespace ramify::cli {

/// Makes the batches, each by a process of its own with one thread, into the folder `runs`, which is there. A
/// run that fails leaves a note in its folder's place, and the rest of its batch is made without it.
/// `report(made)`, called now and then, tells how many runs are made or failed, with the parts of those at
/// work. After a stop all children are ended, what they have not finished is gone and the call returns.
/// Throws RunError if no process can be started.
void make_batches(const SweepPlan& plan, const std::vector<Batch>& batches, const std::filesystem::path& runs,
                  const PoolOptions& options, const std::function<void(double made)>& report);

}  // namespace ramify::cli
