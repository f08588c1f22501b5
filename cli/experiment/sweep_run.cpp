#include "cli/experiment/sweep_run.h"

#include <chrono>
#include <cstdio>

#include "cli/experiment/run_folder.h"
#include "common/base/errors.h"
#include "common/base/memory.h"
#include "common/skeleton/passes.h"

namespace ramify::cli {
namespace {

/// What a run had taken after one of its steps.
struct Cost {
  double seconds = 0.0;
  std::uint64_t peak_memory_bytes = 0;
};

class Meter {
 public:
  Cost now() const {
    return {std::chrono::duration<double>(Clock::now() - start_).count(), process_memory().peak};
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Tells the sweep how far a run is: a byte on stdout for each hundredth.
class Hundredths {
 public:
  void show(const Progress& now) {
    if (now.unit != "step") return;  // of planned trees it is not known how long the other stages will take
    for (; told_ < 100.0 * now.done / now.total; ++told_) std::fputc('.', stdout);
    std::fflush(stdout);
  }

 private:
  int told_ = 0;
};

/// Light and vigour are known of the last step alone; runs leave them out, so that it does not matter which
/// run a tree was cut from.
Skeleton without_last_state(Skeleton tree) {
  tree.light.clear();
  tree.vigour.clear();
  return tree;
}

}  // namespace

void make_runs(const Job& job, std::span<const int> at_steps, const std::filesystem::path& runs,
               const Session& session) {
  const Meter meter;
  std::vector<Cost> costs = {meter.now()};  // after each step, from 0 on
  RunContext context;
  context.stop = session.stop;
  context.wants_history = !at_steps.empty();
  Hundredths hundredths;
  context.progress = [&](const Progress& now) {
    if (context.wants_history) costs.push_back(meter.now());
    hundredths.show(now);
  };
  const RunResult run = job.run(context);
  if (session.stop.stop_requested()) throw Interrupted();
  const Cost whole = meter.now();

  for (const int step : at_steps) {
    Job part = independent_copy(job);
    set_steps(part, step);
    check(part);
    // A tree that stopped at a limit before this step stopped there for good.
    const bool is_reached = static_cast<std::size_t>(step) < costs.size();
    const Cost cost = is_reached ? costs[static_cast<std::size_t>(step)] : whole;
    std::vector<std::string> warnings = part.warnings;
    if (!is_reached) warnings.insert(warnings.end(), run.report.warnings.begin(), run.report.warnings.end());
    write_run(runs, part, cut_at_step(run.skeleton, static_cast<std::uint32_t>(step)), cost.seconds,
              cost.peak_memory_bytes, warnings);
  }
  std::vector<std::string> warnings = job.warnings;
  warnings.insert(warnings.end(), run.report.warnings.begin(), run.report.warnings.end());
  const Skeleton tree = at_steps.empty() ? living(run.skeleton)
                                         : cut_at_step(run.skeleton, static_cast<std::uint32_t>(job.steps()));
  write_run(runs, job, without_last_state(tree), whole.seconds, whole.peak_memory_bytes, warnings);
}

}  // namespace ramify::cli
