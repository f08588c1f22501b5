#include "common/config/presets.h"

#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "common/base/errors.h"

namespace ramify::cli {
namespace {

struct PresetFlags {
  std::string name;
  bool names_only = false;
  bool is_json = false;
};

void print_one(const std::string& name) {
  if (const Preset* preset = find_preset(name)) {
    fmt::print("{}", preset->text);
    return;
  }
  throw InputError(fmt::format("{}: no such preset ({})", name, preset_hint(name)));
}

void print_all(const PresetFlags& flags) {
  std::string_view group;
  for (const Preset& preset : presets()) {
    if (flags.is_json) {
      const nlohmann::ordered_json object = {
          {"name", preset.name}, {"group", preset.group}, {"summary", summary(preset)}};
      fmt::print("{}\n", object.dump());
    } else if (flags.names_only) {
      fmt::print("{}\n", preset.name);
    } else {
      if (preset.group != group) fmt::print("{}{}\n", group.empty() ? "" : "\n", preset.group);
      fmt::print("  {:<16} {}\n", preset.name, summary(preset));
    }
    group = preset.group;
  }
}

}  // namespace

void add_presets(CLI::App& program) {
  auto flags = std::make_shared<PresetFlags>();
  CLI::App* command = program.add_subcommand("presets", "List the presets, or print one, ready to edit");
  command->add_option("name", flags->name, "Print this preset's config")->type_name("NAME");
  command->add_flag("--names", flags->names_only, "Names only, one a line");
  command->add_flag("--json", flags->is_json, "One JSON object a preset");
  command->callback([flags] {
    if (flags->name.empty()) {
      print_all(*flags);
    } else {
      print_one(flags->name);
    }
  });
}

}  // namespace ramify::cli
