// ramify: trees by self-organization and by path planning.

#include <fmt/format.h>

#include <CLI/Error.hpp>
#include <cstdio>
#include <new>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/text.h"
#include "common/base/errors.h"
#include "common/base/large_pages.h"
#include "common/base/memory.h"
#include "common/config/field.h"
#include "common/config/provenance.h"
#include "growth/engine.h"
#include "pathplan/engine.h"

namespace ramify::cli {
namespace {

enum ExitCode { kDone = 0, kFailed = 1, kBadInput = 2, kInterrupted = 130 };

constexpr const char* kFirstSteps = R"(Trees by self-organization and by path planning. Four commands to try:

  ramify presets                                 what can be made
  ramify generate s4-fig6 -o tree.glb            a tree for Blender or a game engine
  ramify render s4-improved xm12-fig5 -o a.png   both methods side by side
  ramify params growth                           every parameter and what it means

`ramify --help` lists all commands, `ramify COMMAND --help` their flags.
)";

int fail(ExitCode code, const std::string& message) {
  fmt::print(stderr, "ramify: {}\n", message);
  return code;
}

/// What is near to a word nobody expected: a command's name or a flag.
std::string suggestion(const std::string& word, const CLI::App& program) {
  std::vector<std::string> known;
  const auto is_shown = [](const CLI::App* command) { return !command->get_group().empty(); };
  for (const CLI::App* command : program.get_subcommands(is_shown)) {
    known.push_back(command->get_name());
  }
  for (const CLI::App* command : program.get_subcommands()) {
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
  }
  const std::string nearest = nearest_name(word, known);
  return nearest.empty() ? "`ramify --help` lists what is" : fmt::format("did you mean '{}'?", nearest);
}

int parse_and_run(CLI::App& program, int argc, char** argv) {
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForHelp& call) {
    return program.exit(call);
  } catch (const CLI::CallForVersion& call) {
    return program.exit(call);
  } catch (const CLI::ExtrasError&) {
    const std::string word = program.remaining(true).front();
    return fail(kBadInput, fmt::format("'{}' is not known ({})", word, suggestion(word, program)));
  } catch (const CLI::ParseError& error) {
    return fail(kBadInput, error.what());
  }
  return kDone;
}

int run(int argc, char** argv) {
  const InterruptWatch watch;
  Session session;
  session.stop = watch.token();
  session.command_line = "ramify";
  for (int i = 1; i < argc; ++i) session.command_line += " " + shell_quoted(argv[i]);
  growth::register_engine(session.registry);
  pathplan::register_engine(session.registry);

  CLI::App program("Trees by self-organization and by path planning", "ramify");
  program.set_version_flag("--version", "ramify " + version());
  program.require_subcommand(0, 1);
  add_generate(program, session);
  add_render(program, session);
  add_view(program, session);
  add_stats(program, session);
  add_compare(program, session);
  add_sweep(program, session);
  add_sweep_draw(program, session);
  add_sweep_run(program, session);
  add_sweep_task(program, session);
  add_convert(program);
  add_presets(program);
  add_params(program, session);
  add_check(program, session);
  try {
    if (argc == 1) {
      fmt::print("{}", kFirstSteps);
      return kDone;
    }
    return parse_and_run(program, argc, argv);
  } catch (const Interrupted& interrupted) {
    return fail(kInterrupted, "interrupted; " + interrupted.outcome);
  } catch (const ConfigError& error) {
    return fail(kBadInput, error.what());
  } catch (const InputError& error) {
    return fail(kBadInput, error.what());
  } catch (const RunError& error) {
    return fail(kFailed, error.what());
  } catch (const std::bad_alloc&) {
    return fail(kFailed, "out of memory");
  } catch (const std::exception& error) {
    // What standard output does not take throws where it is printed; main() says so.
    return std::ferror(stdout) != 0 ? kFailed : fail(kFailed, error.what());
  }
}

}  // namespace
}  // namespace ramify::cli

int main(int argc, char** argv) {
  ramify::drop_symbol_tables();
  ramify::keep_heap_in_large_pages();
  const int code = ramify::cli::run(argc, argv);
  // A full disk behind a redirected stdout must not pass for success.
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    fmt::print(stderr, "ramify: cannot write to standard output\n");
    return code == 0 ? 1 : code;
  }
  return code;
}
