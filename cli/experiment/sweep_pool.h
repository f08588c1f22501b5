// Runs made by child processes, as many at a time as threads and memory allow.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <stop_token>

#include "cli/experiment/sweep_plan.h"

namespace ramify::cli {

struct PoolOptions {
  std::filesystem::path runs;  // where the runs' folders stand; it is there
  int processes = 0;           // at a time; 0: as many as there are cores
  std::stop_token stop;
};

/// Makes the batches, each by a process of its own with one thread. A run that fails leaves a note in its
/// folder's place, and the rest of its batch is made without it. `report(made)`, called now and then, tells
/// how many runs are made or failed. After a stop all children are ended, what they have not finished is gone
/// and the call returns. No more are started than fit into the memory that the machine has left, going by the
/// largest that was seen so far. Throws RunError if no process can be started.
void make_batches(const SweepPlan& plan, std::vector<Batch> batches, const PoolOptions& options,
                  const std::function<void(std::size_t made)>& report);

}  // namespace ramify::cli
