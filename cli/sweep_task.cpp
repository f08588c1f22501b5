#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <memory>

#include "cli/commands.h"
#include "cli/experiment/run_folder.h"
#include "cli/experiment/sweep_folder.h"
#include "cli/experiment/sweep_plan.h"
#include "cli/experiment/sweep_pool.h"
#include "cli/experiment/sweep_results.h"
#include "cli/flags.h"
#include "cli/progress_bar.h"
#include "common/base/errors.h"
#include "common/base/files.h"

namespace ramify::cli {
namespace {

struct TaskFlags {
  std::string plan;
  std::string folder;
  std::size_t slice = 0;
  std::size_t slices = 1;
  RunFlags running;
};

/// Makes what is missing of one slice. Any number of tasks may be at work in the folder, of one slice, too:
/// what is lost is that they make the same runs.
void sweep_task(const TaskFlags& flags, const Session& session) {
  const SweepPlan plan = read_plan(read_file(flags.plan), flags.plan);
  SweepFolder folder(flags.folder);
  folder.join();
  std::vector<std::size_t> missing = unfinished(gather(plan, folder.runs()));
  std::erase_if(missing,
                [&](std::size_t run) { return slice_of(plan.runs[run], flags.slices) != flags.slice; });
  for (const std::size_t run : missing) forget_failure(folder.runs(), plan.runs[run].name);
  ProgressBar bar(flags.running.is_quiet);
  make_batches(plan, batches_of(plan, missing), folder.runs(), {flags.running.threads, session.stop},
               [&](double made) {
                 bar.show({"slice", made, static_cast<double>(missing.size()), "run"});
               });
  bar.clear();
  if (session.stop.stop_requested()) throw Interrupted{"what is made is kept"};
  const SweepResults results = gather(plan, folder.runs());
  const auto failed = std::count_if(missing.begin(), missing.end(),
                                    [&](std::size_t run) { return !results.rows[run].record.has_value(); });
  fmt::print("slice {} of {}: {} runs made\n", flags.slice, flags.slices,
             missing.size() - static_cast<std::size_t>(failed));
  if (failed > 0) throw RunError(fmt::format("{} of {} runs failed", failed, missing.size()));
}

}  // namespace

void add_sweep_task(CLI::App& program, const Session& session) {
  auto flags = std::make_shared<TaskFlags>();
  CLI::App* command = program.add_subcommand("sweep-task", "One slice of a sweep on a cluster");
  command->group("");  // for the job scripts of sweep alone
  command->add_option("plan", flags->plan)->required();
  command->add_option("-o,--output", flags->folder)->required();
  command->add_option("--slice", flags->slice)->required();
  command->add_option("--slices", flags->slices)->required()->check(CLI::PositiveNumber);
  flags->running.add_to(*command);
  command->callback([flags, &session] { sweep_task(*flags, session); });
}

}  // namespace ramify::cli
