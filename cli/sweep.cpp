#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/experiment/plots.h"
#include "cli/experiment/process.h"
#include "cli/experiment/slurm_job.h"
#include "cli/experiment/sweep_figures.h"
#include "cli/experiment/sweep_folder.h"
#include "cli/experiment/sweep_pictures.h"
#include "cli/experiment/sweep_plan.h"
#include "cli/experiment/sweep_pool.h"
#include "cli/experiment/sweep_report.h"
#include "cli/experiment/sweep_results.h"
#include "cli/experiment/sweep_run.h"
#include "cli/experiment/value_list.h"
#include "cli/flags.h"
#include "cli/progress_bar.h"
#include "cli/text.h"
#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/base/image.h"
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
  if (flags.on_slurm && flags.collects) {
    throw InputError("--slurm, --collect: one of them (submit, then collect)");
  }
  if (!flags.on_slurm && flags.slurm.tasks > 0) throw InputError("--tasks: goes with --slurm");
  if (!flags.on_slurm && !flags.slurm.sbatch_options.empty()) {
    throw InputError("--sbatch-options: goes with --slurm");
  }
  if (flags.slurm.sbatch_options.find('\n') != std::string::npos) {
    throw InputError("--sbatch-options: is more than a line");
  }
  const std::vector<Override> overrides = flags.configuring.overrides();
  if (flags.collects && flags.config.empty() && flags.axes.empty()) {
    if (!overrides.empty()) throw InputError(fmt::format("{}: goes with CONFIG", overrides.front().flag));
    return;  // the folder tells them
  }
  if (flags.config.empty()) throw InputError("config is required");
  if (flags.axes.empty()) throw InputError("--vary is required");
}

/// Makes the runs that are not finished. Throws Interrupted after Ctrl-C.
void make_missing(const SweepPlan& plan, const SweepFolder& folder, const SweepFlags& flags,
                  const Session& session) {
  const std::vector<std::size_t> missing = unfinished(gather(plan, folder.runs()));
  for (const std::size_t run : missing) forget_failure(folder.runs(), plan.runs[run].name);
  ProgressBar bar(flags.running.is_quiet);
  make_batches(plan, batches_of(plan, missing), folder.runs(), {flags.running.threads, session.stop},
               [&](double made) {
                 bar.show({"sweep", made, static_cast<double>(missing.size()), "run"});
               });
  bar.clear();
  if (!session.stop.stop_requested()) return;
  const std::size_t done = gather(plan, folder.runs()).count_done();
  throw Interrupted{fmt::format("{} of {} runs are made and kept; the same command goes on from there", done,
                                plan.runs.size())};
}

/// Has the trees drawn, if there is anything to draw with, and lays out their contact sheet.
void draw_pictures(SweepFindings& findings, const SweepFolder& folder, const PoolOptions& options,
                   ProgressBar& bar) {
  findings.picture_side = picture_side(findings.results.rows.size());
  findings.picture_columns = picture_columns(findings.results.plan);
  SweepPictures pictures =
      draw_runs(findings.results, folder, options, [&](std::size_t done, std::size_t total) {
        bar.show({"drawing", static_cast<double>(done), static_cast<double>(total), "picture"});
      });
  findings.pictures = std::move(pictures.files);
  const auto drawn = std::count_if(findings.pictures.begin(), findings.pictures.end(),
                                   [](const std::string& file) { return !file.empty(); });
  if (pictures.failure) {
    findings.notes.push_back(drawn == 0 ? fmt::format("There are no pictures: {}.", *pictures.failure)
                                        : fmt::format("Pictures are missing: {}.", *pictures.failure));
  }
  if (drawn == 0) return;
  folder.write("contact-sheet.png", png_bytes(labelled_sheet(findings.results, findings.pictures)));
}

/// Draws the figures where there is gnuplot, and keeps the SVGs for the report.
void draw_figures(SweepFindings& findings, const SweepFolder& folder, int processes) {
  findings.responses = responses_of(findings.results);
  findings.has_gnuplot = has_gnuplot();
  if (!findings.has_gnuplot) return;
  const std::vector<Plot> lines = lines_of(findings.responses);
  const std::vector<HeatMap> maps = maps_of(findings.responses);
  const std::filesystem::path plots = folder.path() / "plots";
  std::filesystem::create_directory(plots);
  draw_plots(lines, plots, processes);
  draw_heat_maps(maps, plots, processes);
  const auto keep = [&](const std::string& name) {
    findings.figure_svgs.push_back(read_file(plots / (name + ".svg")));
  };
  for (const Plot& plot : lines) keep(plot.name);
  for (const HeatMap& map : maps) keep(map.name);
}

/// Writes what is told of the runs.
SweepFindings report(const SweepPlan& plan, const SweepFolder& folder, const SweepFlags& flags,
                     const Session& session) {
  ProgressBar bar(flags.running.is_quiet);
  SweepFindings findings;
  findings.results = gather(plan, folder.runs());
  folder.write("results.csv", results_csv(findings.results));
  draw_pictures(findings, folder, {flags.running.threads, session.stop}, bar);
  draw_figures(findings, folder, flags.running.threads);
  folder.write("report.html", sweep_report(findings));
  return findings;
}

void print_outcome(const SweepFindings& findings, const SweepFlags& flags, std::size_t made) {
  const std::filesystem::path folder = flags.folder;
  const SweepResults& results = findings.results;
  if (flags.running.is_json) {
    const nlohmann::ordered_json object = {{"report", (folder / "report.html").string()},
                                           {"results", (folder / "results.csv").string()},
                                           {"gnuplot", findings.has_gnuplot},
                                           {"runs", results.rows.size()},
                                           {"done", results.count_done()},
                                           {"failed", results.rows.size() - results.count_done()},
                                           {"made_now", made}};
    fmt::print("{}\n", object.dump());
  } else if (!flags.running.is_quiet) {
    fmt::print("{}\n{} made now\n  {}\n  {}\n", sweep_in_words(findings), grouped(made),
               (folder / "results.csv").string(), (folder / "report.html").string());
  }
}

/// Hands the runs that are not finished to Slurm, one at least.
void submit_missing(const SweepPlan& plan, const SweepFolder& folder, std::span<const std::size_t> missing,
                    const SweepFlags& flags) {
  SlurmOptions options = flags.slurm;
  options.threads = flags.running.threads;
  const SlurmJob job = submit(plan, missing, folder.path(), options);
  if (flags.running.is_json) {
    const nlohmann::ordered_json object = {{"runs", plan.runs.size()},
                                           {"submitted", missing.size()},
                                           {"job", job.id},
                                           {"tasks", job.tasks},
                                           {"folder", job.folder.string()}};
    fmt::print("{}\n", object.dump());
  } else if (!flags.running.is_quiet) {
    fmt::print(
        "job {}: {} of {} runs in {} tasks\n  squeue --job {} tells how far it is\n  ramify sweep -o {} "
        "--collect gathers\n",
        job.id, grouped(missing.size()), grouped(plan.runs.size()), job.tasks, job.id,
        shell_quoted(flags.folder));
  }
}

/// Reports what there is. `done_before`: runs that were finished when this began.
void finish(const SweepPlan& plan, const SweepFolder& folder, const SweepFlags& flags,
            std::size_t done_before, const Session& session) {
  const SweepFindings findings = report(plan, folder, flags, session);
  const SweepResults& results = findings.results;
  print_outcome(findings, flags, results.count_done() - done_before);
  const std::size_t missing = results.rows.size() - results.count_done() - results.count_failed();
  if (missing > 0) throw RunError(missing_text(results, folder.path()));
  if (results.count_failed() > 0) {
    throw RunError(fmt::format("{} of {} runs failed ({} says why)", results.count_failed(),
                               results.rows.size(), (folder.path() / "results.csv").string()));
  }
}

/// What there is of a sweep that other processes make, or made.
void collect(const SweepFlags& flags, const Session& session) {
  const std::filesystem::path plan_file = std::filesystem::path(flags.folder) / kPlanFile;
  std::error_code error;
  if (!std::filesystem::is_regular_file(plan_file, error)) {
    throw InputError(fmt::format("--collect: {}: no sweep is there", flags.folder));
  }
  const SweepPlan plan =
      flags.config.empty() ? read_plan(read_file(plan_file), plan_file.string()) : plan_of(flags, session);
  const SweepFolder folder(flags.folder);
  finish(plan, folder, flags, gather(plan, folder.runs()).count_done(), session);
}

void sweep(const SweepFlags& flags, const Session& session) {
  check_flags(flags);
  const ThreadLimit limit(flags.running.threads);
  if (flags.collects) return collect(flags, session);
  const SweepPlan plan = plan_of(flags, session);
  SweepFolder folder(flags.folder);
  if (!flags.on_slurm) folder.lock();
  folder.write(kPlanFile, plan_text(plan));
  const SweepResults before = gather(plan, folder.runs());
  const std::vector<std::size_t> missing = unfinished(before);
  if (flags.on_slurm && !missing.empty()) return submit_missing(plan, folder, missing, flags);
  make_missing(plan, folder, flags, session);
  finish(plan, folder, flags, before.count_done(), session);
}

struct SweepRunFlags {
  std::string config;
  std::string runs;
  std::vector<int> at_steps;
  RunFlags running;
};

void sweep_run(const SweepRunFlags& flags, const Session& session) {
  end_with_parent();
  const ThreadLimit limit(flags.running.threads);
  make_runs(load_job(session.registry, flags.config), flags.at_steps, flags.runs, session);
}

void add_cluster_flags(CLI::App& command, SweepFlags& flags) {
  command.add_flag("--slurm", flags.on_slurm,
                   "Hand the runs to Slurm as an array job; DIR must be on a disk that its machines share");
  command
      .add_option("--tasks", flags.slurm.tasks,
                  "With --slurm: tasks that share the runs, 16 at most if not given")
      ->type_name("N")
      ->check(CLI::Range(1, static_cast<int>(kMaxRuns)));
  command
      .add_option("--sbatch-options", flags.slurm.sbatch_options,
                  "With --slurm: more options of sbatch, such as '--partition=long --time=2:00:00'")
      ->type_name("TEXT");
  command.add_flag("--collect", flags.collects,
                   "Only gather the runs that are there; CONFIG and --vary may be left out");
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
  add_cluster_flags(*command, *flags);
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
