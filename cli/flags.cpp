#include "cli/flags.h"

#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <cstdio>

#include "cli/commands.h"
#include "cli/progress_bar.h"
#include "common/base/errors.h"
#include "common/base/parallel.h"

namespace ramify::cli {

void ConfigFlags::add_to(CLI::App& command) {
  command
      .add_option(
          "--set", assignments,
          "Set a parameter, e.g. growth.alpha=2; lists count from 1 (repeatable; see `ramify params`)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.add_option("--seed", seed, "The same seed makes the same tree")->type_name("N");
  command.add_option("--steps", steps, "Steps to grow; for pathplan the number of levels")->type_name("N");
}

std::vector<Override> ConfigFlags::overrides() const {
  std::vector<Override> result;
  for (const std::string& assignment : assignments) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw InputError(fmt::format("--set: '{}' is no KEY=VALUE", assignment));
    }
    result.push_back({"--set", assignment.substr(0, equals), assignment.substr(equals + 1)});
  }
  // After --set, so that the shorter flag wins.
  if (!seed.empty()) result.push_back({"--seed", "seed", seed});
  if (!steps.empty()) result.push_back({"--steps", "steps", steps});
  return result;
}

void RunFlags::add_to(CLI::App& command) {
  command.add_option("--threads", threads, "Threads to use; 0: all")
      ->type_name("N")
      ->check(CLI::Range(0, 1024));
  command.add_flag("--quiet", is_quiet, "No progress, no summary");
  command.add_flag("--json", is_json, "Print one JSON object instead of the summary");
}

void add_up_flag(CLI::App& command, SkeletonReading& reading) {
  const auto set = [&reading](const std::string& axis) {
    if (axis != "y" && axis != "z") throw InputError(fmt::format("--up: '{}' (y | z)", axis));
    reading.up = axis == "y" ? UpAxis::y : UpAxis::z;
  };
  command
      .add_option_function<std::string>(
          "--up", set, "Which coordinate points up in skeleton files read; else as their format has it")
      ->type_name("y|z");
}

RunResult run_with_progress(const Job& job, RunContext context, const RunFlags& flags) {
  const ThreadLimit limit(flags.threads);
  for (const std::string& warning : job.warnings) warn(warning);
  ProgressBar bar(flags.is_quiet);
  context.progress = [&bar](const Progress& now) { bar.show(now); };
  RunResult result = job.run(context);
  bar.clear();
  if (context.stop.stop_requested()) throw Interrupted();
  for (const std::string& warning : result.report.warnings) warn(warning);
  return result;
}

void warn(const std::string& text) {
  fmt::print(stderr, "ramify: warning: {}\n", text);
}

void note(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) fmt::print(stderr, "ramify: note: {}\n", text);
}

}  // namespace ramify::cli
