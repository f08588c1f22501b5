#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/prctl.h>

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/commands.h"
#include "cli/experiment/slurm_job.h"
#include "cli/experiment/sweep_folder.h"
#include "cli/experiment/sweep_plan.h"
#include "cli/experiment/sweep_pool.h"
#include "cli/experiment/sweep_results.h"
#include "cli/experiment/sweep_run.h"
#include "cli/experiment/value_list.h"
#include "cli/flags.h"
#include "cli/progress_bar.h"
#include "cli/text.h"
#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/base/parallel.h"

namespace ramify::cli {
namespace {

constexpr const char* kExamples = R"(
Examples:
  ramify sweep s4-fig6 --vary steps=3:15:1 -o steps
      thirteen trees out of one that grows for 15 steps
  ramify sweep p09-fig7-50 --vary growth.lambda=0.46:0.54:0.02 --vary seed=1:8:1 -o lambda
      40 trees; plots show the mean and spread of the eight seeds
  ramify sweep s4-fig6 --vary growth.w_optimal=0,0.5,1 --vary growth.tropism.up.weight=0,0.3 -o map
      every combination: heat maps
  ramify sweep xm12-fig5 --vary 'pathplan.levels.1.weights=incremental,periodic' -o bends
      words work, too; so do lists and tables in TOML: --vary 'growth.lambda=[[1,0.6],[8,0.5]],0.5'

A range from:to:step includes `to`. The same command again goes on where it was interrupted; more values make
only the runs that are new. Each run's folder, DIR/runs/NAME, has its complete config and its tree.)";

struct SweepFlags {
  std::string config;
  std::vector<std::string> axes;
  std::string folder;
  bool on_slurm = false;
  bool collects = false;
  SlurmOptions slurm;
  ConfigFlags configuring;
  RunFlags running;
};

std::string command_line(const SweepFlags& flags, const SweepPlan& plan) {
  std::string text = "ramify sweep " + shell_quoted(flags.config);
  for (const std::string& axis : flags.axes) text += " --vary " + shell_quoted(axis);
  return text + plan.flags + " -o " + shell_quoted(flags.folder);
}

SweepPlan plan_of(const SweepFlags& flags, const Session& session) {
  std::vector<Axis> axes;
  for (const std::string& text : flags.axes) axes.push_back(axis_of(text));
  SweepPlan plan = plan_sweep(session.registry, flags.config, flags.configuring.overrides(), axes);
  plan.command = command_line(flags, plan);
  return plan;
}

void check_flags(const SweepFlags& flags) {
  if (flags.on_slurm && flags.collects)
    throw InputError("--slurm, --collect: one of them (submit, then collect)");
  if (!flags.on_slurm && flags.slurm.tasks > 0) throw InputError("--tasks: goes with --slurm");
  if (!flags.on_slurm && !flags.slurm.sbatch_options.empty()) {
    throw InputError("--sbatch-options: goes with --slurm");
  }
  if (flags.slurm.sbatch_options.find('\n') != std::string::npos) {
    throw InputError("--sbatch-options: is more than a line");
  }
  const bool is_from_folder = flags.collects && flags.config.empty() && flags.axes.empty();
  if (!is_from_folder && flags.config.empty())
    throw InputError("sweep: CONFIG is missing (a preset or a TOML file)");
  if (!is_from_folder && flags.axes.empty()) throw InputError("--vary: is missing (KEY=LIST)");
}

/// Makes the runs that are not finished. Throws Interrupted after Ctrl-C.
void make_missing(const SweepPlan& plan, const SweepFolder& folder, const SweepFlags& flags,
                  const Session& session) {
  const std::vector<std::size_t> missing = unfinished(gather(plan, folder.runs()));
  for (const std::size_t run : missing) forget_failure(folder.runs(), plan.runs[run].name);
  ProgressBar bar(flags.running.is_quiet);
  const PoolOptions options{folder.runs(), flags.running.threads, session.stop};
  make_batches(plan, batches_of(plan, missing), options, [&](std::size_t made) {
    bar.show({"sweep", static_cast<double>(made), static_cast<double>(missing.size()), "run"});
  });
  bar.clear();
  if (!session.stop.stop_requested()) return;
  const std::size_t done = gather(plan, folder.runs()).count_done();
  throw Interrupted{fmt::format("{} of {} runs are made and kept; the same command goes on from there", done,
                                plan.runs.size())};
}

void print_outcome(const SweepResults& results, const SweepFlags& flags, std::size_t made) {
  const std::string table = (std::filesystem::path(flags.folder) / "results.csv").string();
  if (flags.running.is_json) {
    const nlohmann::ordered_json object = {{"runs", results.rows.size()},
                                           {"done", results.count_done()},
                                           {"failed", results.count_failed()},
                                           {"made_now", made},
                                           {"results", table}};
    fmt::print("{}\n", object.dump());
  } else if (!flags.running.is_quiet) {
    fmt::print("{} of {} runs are done, {} of them made now\n  {}\n", grouped(results.count_done()),
               grouped(results.rows.size()), grouped(made), table);
  }
}

/// Hands the runs that are not finished to Slurm, one at least.
void submit_missing(const SweepPlan& plan, const SweepFolder& folder, std::span<const std::size_t> missing,
                    const SweepFlags& flags) {
  SlurmOptions options = flags.slurm;
  options.threads = flags.running.threads;
  const SlurmJob job = submit(plan, missing, folder.path(), options);
  const std::string next = fmt::format("ramify sweep -o {} --collect", shell_quoted(flags.folder));
  if (flags.running.is_json) {
    const nlohmann::ordered_json object = {{"runs", plan.runs.size()},
                                           {"submitted", missing.size()},
                                           {"job", job.id},
                                           {"tasks", job.tasks},
                                           {"folder", job.folder.string()}};
    fmt::print("{}\n", object.dump());
  } else if (!flags.running.is_quiet) {
    fmt::print("job {}: {} of {} runs in {} tasks\n", job.id, grouped(missing.size()),
               grouped(plan.runs.size()), job.tasks);
    fmt::print("  squeue --job {} tells how far it is; then: {}\n", job.id, next);
  }
}

/// Which runs are missing still, and what can be done about it.
RunError missing_error(const SweepPlan& plan, const SweepFolder& folder, const SweepResults& results) {
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    if (status_of(results.rows[i]) == "missing") missing.push_back(i);
  }
  std::string text = fmt::format("{} of {} runs are missing", missing.size(), plan.runs.size());
  if (const auto job = submitted(folder.path(), plan)) {
    std::set<std::size_t> tasks;
    for (const std::size_t run : missing) tasks.insert(slice_of(plan.runs[run], job->slices));
    text += fmt::format(", of job {}'s tasks {} (squeue --job {} tells whether they run; logs: {})", job->id,
                        fmt::join(tasks, ", "), job->id, (job->folder / "task-K.log").string());
  }
  return RunError(text + ": the sweep's command makes them here, or with --slurm there");
}

/// Writes the results and reports failures. `done_before`: runs that were finished when this began.
void finish(const SweepPlan& plan, const SweepFolder& folder, const SweepFlags& flags,
            std::size_t done_before) {
  const SweepResults results = gather(plan, folder.runs());
  folder.write("results.csv", results_csv(results));
  print_outcome(results, flags, results.count_done() - done_before);
  const std::size_t failed = results.count_failed();
  if (failed > 0) {
    throw RunError(fmt::format("{} of {} runs failed ({} says why)", failed, results.rows.size(),
                               (folder.path() / "results.csv").string()));
  }
  if (results.count_done() < results.rows.size()) throw missing_error(plan, folder, results);
}

/// What runs there are of a sweep that other processes make, or made.
void collect(const SweepFlags& flags, const Session& session) {
  const std::filesystem::path plan_file = std::filesystem::path(flags.folder) / kPlanFile;
  std::error_code error;
  if (!std::filesystem::is_regular_file(plan_file, error)) {
    throw InputError(fmt::format("--collect: {}: no sweep is there", flags.folder));
  }
  const SweepPlan plan =
      flags.config.empty() ? read_plan(read_file(plan_file), plan_file.string()) : plan_of(flags, session);
  const SweepFolder folder(flags.folder);
  finish(plan, folder, flags, gather(plan, folder.runs()).count_done());
}

void sweep(const SweepFlags& flags, const Session& session) {
  check_flags(flags);
  if (flags.collects) return collect(flags, session);
  const SweepPlan plan = plan_of(flags, session);
  SweepFolder folder(flags.folder);
  if (!flags.on_slurm) folder.lock();
  folder.write(kPlanFile, plan_text(plan));
  const SweepResults before = gather(plan, folder.runs());
  const std::vector<std::size_t> missing = unfinished(before);
  if (flags.on_slurm && !missing.empty()) return submit_missing(plan, folder, missing, flags);
  make_missing(plan, folder, flags, session);
  finish(plan, folder, flags, before.count_done());
}

struct SweepRunFlags {
  std::string config;
  std::string runs;
  std::vector<int> at_steps;
  RunFlags running;
};

void sweep_run(const SweepRunFlags& flags, const Session& session) {
  // A sweep that is killed takes its runs along.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const ThreadLimit limit(flags.running.threads);
  make_runs(load_job(session.registry, flags.config), flags.at_steps, flags.runs, session);
}

}  // namespace

void add_sweep(CLI::App& program, const Session& session) {
  auto flags = std::make_shared<SweepFlags>();
  CLI::App* command = program.add_subcommand(
      "sweep", "A run for each combination of values, gathered in one table and report");
  command->footer(kExamples);
  command->add_option("config", flags->config, "A preset (`ramify presets`) or a TOML file")
      ->type_name("CONFIG");
  command
      ->add_option("--vary", flags->axes,
                   "Give a parameter these values, a,b,c or from:to:step; seed and steps, too (repeatable: "
                   "every combination is made)")
      ->type_name("KEY=LIST")
      ->allow_extra_args(false);
  command->add_option("-o,--output", flags->folder, "Folder for the runs and what is gathered from them")
      ->type_name("DIR")
      ->required();
  command->add_flag("--slurm", flags->on_slurm,
                    "Hand the runs to Slurm as an array job; DIR must be on a disk that its machines share");
  command
      ->add_option("--tasks", flags->slurm.tasks,
                   "With --slurm: tasks that share the runs, 16 at most if not given")
      ->type_name("N")
      ->check(CLI::Range(1, static_cast<int>(kMaxRuns)));
  command
      ->add_option("--sbatch-options", flags->slurm.sbatch_options,
                   "With --slurm: more options of sbatch, such as '--partition=long --time=2:00:00'")
      ->type_name("TEXT");
  command->add_flag("--collect", flags->collects,
                    "Only gather the runs that are there; CONFIG and --vary may be left out");
  flags->configuring.add_to(*command);
  flags->running.add_to(*command);
  command->callback([flags, &session] { sweep(*flags, session); });
}

void add_sweep_run(CLI::App& program, const Session& session) {
  auto flags = std::make_shared<SweepRunFlags>();
  CLI::App* command = program.add_subcommand("sweep-run", "One run of a sweep, into its folder");
  command->group("");  // for sweep alone
  command->add_option("config", flags->config)->required();
  command->add_option("-o,--output", flags->runs)->required();
  command->add_option("--at-step", flags->at_steps)->allow_extra_args(false);
  flags->running.add_to(*command);
  command->callback([flags, &session] { sweep_run(*flags, session); });
}

}  // namespace ramify::cli
