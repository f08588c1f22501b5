#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <memory>

#include "cli/commands.h"
#include "cli/flags.h"

namespace ramify::cli {

void add_check(CLI::App& program, const Session& session) {
  struct Flags {
    std::vector<std::string> configs;
    ConfigFlags configuring;
    bool is_quiet = false;
  };
  auto flags = std::make_shared<Flags>();
  CLI::App* command = program.add_subcommand("check", "Read and validate configs, make nothing");
  command->add_option("config", flags->configs, "Presets or TOML files")->type_name("CONFIG")->required();
  flags->configuring.add_to(*command);
  command->add_flag("--quiet", flags->is_quiet, "Print only what is wrong");
  command->callback([flags, &session] {
    for (const std::string& config : flags->configs) {
      const Job job = load_job(session.registry, config, flags->configuring.overrides());
      for (const std::string& warning : job.warnings) warn(fmt::format("{}: {}", config, warning));
      if (flags->is_quiet) continue;
      fmt::print("{}: sound ({}, {} step{})\n", config, job.engine->name, job.steps(),
                 job.steps() == 1 ? "" : "s");
    }
  });
}

}  // namespace ramify::cli
