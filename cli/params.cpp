#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Option.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/commands.h"
#include "common/base/errors.h"
#include "common/config/job.h"
#include "common/config/toml_writer.h"

namespace ramify::cli {
namespace {

constexpr const char* kSources = R"(
Sources: P09 Palubicki et al. 2009, Self-organizing tree models for image synthesis; SOT the values of its public
demo; S4 Tree Generation, a student report; XM12 Xu and Mould 2012, A procedural method for irregular tree models;
XM15 Xu and Mould 2015, Procedural tree modeling with guiding vectors; X18 Xu 2018, Three-dimensional irregular tree
modeling for special virtual environments.
)";

struct ParamsFlags {
  std::string engine;
  bool is_toml = false;
  bool is_json = false;
};

/// One parameter as it is listed. Items of lists are called N, of maps NAME.
struct Parameter {
  std::string key;
  const FieldRow* row = nullptr;
  std::string default_value;
};

/// Collects the parameters of a table whose owner holds the defaults. A table inside itself is not entered,
/// nor are the items of a list that are like those of a list before (`listed`).
void collect(const Table& table, void* owner, const std::string& prefix, std::vector<const Table*> around,
             std::set<const Table*>& listed, std::vector<Parameter>& found) {
  around.push_back(&table);
  for (const FieldRow& row : table) {
    const std::string key = prefix + row.key;
    void* member = row.member(owner);
    const bool is_nested =
        row.kind == FieldKind::group || row.kind == FieldKind::list || row.kind == FieldKind::map;
    if (!is_nested) {
      found.push_back({key, &row, toml_value(row, member)});
      continue;
    }
    const bool is_inside_itself = std::find(around.begin(), around.end(), &row.child()) != around.end();
    const bool is_known = row.kind == FieldKind::list && !listed.insert(&row.child()).second;
    if (is_inside_itself || is_known) {
      found.push_back({key, &row, "[]"});
    } else if (row.kind == FieldKind::group) {
      collect(row.child(), member, key + ".", around, listed, found);
    } else if (row.kind == FieldKind::list) {
      row.clear(member);
      collect(row.child(), row.append(member), key + ".N.", around, listed, found);
    } else {
      collect(row.child(), row.named(member, "NAME"), key + ".NAME.", around, listed, found);
    }
  }
}

void print_parameters(const AnyEngine& engine, bool is_json) {
  Job job = default_job(engine);
  const Table table = job_table(engine);
  std::vector<Parameter> parameters;
  std::set<const Table*> listed;
  collect(table, &job, "", {}, listed, parameters);
  if (!is_json) fmt::print("{}\n", engine.name);
  for (const auto& [key, row, default_value] : parameters) {
    const FieldInfo& info = row->info;
    if (is_json) {
      const nlohmann::ordered_json object = {
          {"engine", engine.name},    {"key", key},        {"allowed", allowed_values(*row)},
          {"default", default_value}, {"unit", info.unit}, {"meaning", info.help},
          {"source", info.source}};
      fmt::print("{}\n", object.dump());
      continue;
    }
    fmt::print("  {} = {}\n      {}\n      {}{}{}\n", key, default_value, info.help, allowed_values(*row),
               info.unit.empty() ? "" : "; " + info.unit,
               info.source.empty() ? "" : " [" + info.source + "]");
  }
}

void print_params(const ParamsFlags& flags, const EngineRegistry& registry) {
  const AnyEngine* only = flags.engine.empty() ? nullptr : registry.find(flags.engine);
  if (!flags.engine.empty() && !only) {
    throw InputError(fmt::format("'{}' is no engine ({})", flags.engine, fmt::join(registry.names(), " | ")));
  }
  if (flags.is_toml && !only) {
    throw InputError(fmt::format("--toml: name the engine ({})", fmt::join(registry.names(), " | ")));
  }
  if (flags.is_toml) {
    fmt::print("{}", to_toml(default_job(*only), true));
    return;
  }
  for (const AnyEngine& engine : registry.engines()) {
    if (!only || only == &engine) print_parameters(engine, flags.is_json);
  }
  if (!flags.is_json) fmt::print("{}", kSources);
}

}  // namespace

void add_params(CLI::App& program, const Session& session) {
  auto flags = std::make_shared<ParamsFlags>();
  CLI::App* command =
      program.add_subcommand("params", "List every parameter: default, meaning, what is allowed, source");
  command->add_option("engine", flags->engine, "growth or pathplan; both if left out")->type_name("ENGINE");
  command->add_flag("--toml", flags->is_toml, "Print a complete commented config");
  command->add_flag("--json", flags->is_json, "One JSON object a parameter");
  command->callback([flags, &session] { print_params(*flags, session.registry); });
}

}  // namespace ramify::cli
