// Flags that several commands share, and how a job is run under them.
#pragma once

#include <CLI/App.hpp>
#include <stop_token>
#include <string>
#include <vector>

#include "common/config/job.h"
#include "common/format/skeleton_files.h"

namespace ramify::cli {

/// Flags that lay values over a config.
struct ConfigFlags {
  std::vector<std::string> assignments;  // --set
  std::string seed;                      // TOML, empty if not given
  std::string steps;

  void add_to(CLI::App& command);
  /// Throws InputError for a --set without '='.
  std::vector<Override> overrides() const;
};

/// Flags of commands that run an engine.
struct RunFlags {
  int threads = 0;  // 0: all
  bool is_quiet = false;
  bool is_json = false;

  void add_to(CLI::App& command);
};

/// --up, for commands that read skeleton files.
void add_up_flag(CLI::App& command, SkeletonReading& reading);

/// Runs a job with progress and its warnings on stderr. Throws Interrupted after Ctrl-C.
RunResult run_with_progress(const Job& job, RunContext context, const RunFlags& flags);

/// One line "ramify: warning: ..." on stderr.
void warn(const std::string& text);

/// A line "ramify: note: ..." on stderr for each.
void note(const std::vector<std::string>& texts);

}  // namespace ramify::cli
