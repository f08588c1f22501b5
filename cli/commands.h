// The program's commands, one file each: each adds itself to the command line and runs when it is called.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <stop_token>
#include <string>

#include "common/config/engine.h"

namespace ramify::cli {

/// Ctrl-C: main() says what has become of the outputs and exits with 130.
struct Interrupted {
  std::string outcome = "nothing written";
};

/// What all commands share.
struct Session {
  EngineRegistry registry;
  std::stop_token stop;      // requested by Ctrl-C
  std::string command_line;  // as it was typed, ready to be typed again
};

void add_generate(CLI::App& program, const Session& session);
void add_render(CLI::App& program, const Session& session);
void add_stats(CLI::App& program, const Session& session);
void add_compare(CLI::App& program, const Session& session);
void add_sweep(CLI::App& program, const Session& session);
void add_sweep_draw(CLI::App& program, const Session& session);
void add_sweep_run(CLI::App& program, const Session& session);
void add_sweep_task(CLI::App& program, const Session& session);
void add_convert(CLI::App& program);
void add_presets(CLI::App& program);
void add_params(CLI::App& program, const Session& session);
void add_view(CLI::App& program, const Session& session);
void add_check(CLI::App& program, const Session& session);

}  // namespace ramify::cli
