#include "common/config/job.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <functional>
#include <optional>

#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/config/inheritance.h"
#include "common/config/presets.h"
#include "common/config/toml_writer.h"
#include "common/format/embedded_config.h"

namespace ramify {
namespace {

namespace fs = std::filesystem;

// A chain of bases longer than this is a circle.
constexpr int kMaxBaseDepth = 16;

/// A config's text and what to call it in messages.
struct Source {
  std::string name;
  fs::path folder;  // where its base and the files it names are looked for
  std::string text;
};

Source find_source(const std::string& config, const fs::path& folder, const std::string& where) {
  if (const Preset* preset = find_preset(config)) return {config, {}, std::string(preset->text)};
  const fs::path path = folder / config;
  std::error_code error;
  if (fs::exists(path, error)) {
    const std::string name = folder.empty() ? config : path.string();
    // The paths in an embedded config are those of the run that made the file: from its working folder.
    if (may_embed_config(path)) return {name, {}, embedded_config(path)};
    return {name, path.parent_path(), read_file(path)};
  }

  const std::string problem = fmt::format("no such file or preset ({})", preset_hint(config));
  if (where.empty()) throw InputError(fmt::format("{}: {}", config, problem));
  throw ConfigError(where, "base", fmt::format("'{}': {}", config, problem));
}

/// The engine that a text names; its base's where it names none.
const AnyEngine& named_engine(const EngineRegistry& registry, const TomlDocument& document,
                              const AnyEngine* base_engine) {
  const std::optional<std::string> name = document.top_string("engine");
  const std::string known = fmt::format("{}", fmt::join(registry.names(), " | "));
  if (!name && base_engine) return *base_engine;
  if (!name) throw ConfigError(document.where("engine"), "engine", fmt::format("missing ({})", known));
  const AnyEngine* engine = registry.find(*name);
  if (!engine) {
    throw ConfigError(document.where("engine"), "engine",
                      fmt::format("'{}' is not known ({})", *name, known));
  }
  if (base_engine && engine != base_engine) {
    throw ConfigError(document.where("engine"), "engine",
                      fmt::format("'{}' differs from the base's ({})", *name, base_engine->name));
  }
  return *engine;
}

void read_source(const EngineRegistry& registry, const Source& source, int depth, Job& job,
                 Origins& origins) {
  const TomlDocument document(source.text, source.name, source.folder);
  if (const std::optional<std::string> base = document.top_string("base")) {
    if (depth >= kMaxBaseDepth) {
      throw ConfigError(
          document.where("base"), "base",
          fmt::format("more than {} configs based on each other (is it a circle?)", kMaxBaseDepth));
    }
    read_source(registry, find_source(*base, source.folder, document.where("base")), depth + 1, job, origins);
  }
  const AnyEngine& engine = named_engine(registry, document, job.engine);
  if (!job.engine) {
    job.engine = &engine;
    job.parameters = engine.make_parameters();
  }
  document.read_into(job_table(engine), &job, {"engine", "base"}, origins);
}

/// Where `key`, or the nearest table around it, was set.
std::string origin_of(std::string key, const Origins& origins, const std::string& fallback) {
  while (!key.empty()) {
    if (const auto found = origins.find(key); found != origins.end()) return found->second;
    const std::size_t dot = key.rfind('.');
    key.resize(dot == std::string::npos ? 0 : dot);
  }
  return fallback;
}

/// Runs a check that knows only the keys below its table, and says where the table's key was set.
void check_table(const std::string& table, const Job& job, const Origins& origins,
                 const std::function<void()>& check) {
  try {
    check();
  } catch (const ConfigError& error) {
    const std::string key = fmt::format("{}.{}", table, error.key());
    throw ConfigError(origin_of(key, origins, job.name), key, error.problem());
  }
}

std::vector<std::string> checked(const Job& job, const Origins& origins) {
  check_table("bark", job, origins, [&] { check_bark(job.bark); });
  check_table("leaves", job, origins, [&] { check_leaves(job.leaves); });
  if (job.mesher.sides_min > job.mesher.sides_max) {
    throw ConfigError(
        origin_of("mesher.sides_min", origins, job.name), "mesher.sides_min",
        fmt::format("{} is more than sides_max (at most {})", job.mesher.sides_min, job.mesher.sides_max));
  }
  try {
    return job.engine->check(job.parameters.get());
  } catch (const ConfigError& error) {
    const std::string first = error.key().substr(0, error.key().find('.'));
    bool is_top = false;
    for (const FieldRow& row : job.engine->top_fields) is_top = is_top || row.key == first;
    const std::string key = is_top ? error.key() : fmt::format("{}.{}", job.engine->name, error.key());
    throw ConfigError(origin_of(key, origins, job.name), key, error.problem());
  }
}

}  // namespace

std::string version() {
  return RAMIFY_VERSION;
}

Table job_table(const AnyEngine& engine) {
  const auto parameters_of = [](void* job) { return static_cast<Job*>(job)->parameters.get(); };
  Table table;
  for (FieldRow row : engine.top_fields) {
    row.member = [parameters_of, member = row.member](void* job) { return member(parameters_of(job)); };
    table.push_back(std::move(row));
  }
  FieldRow engine_row;
  engine_row.key = engine.name;
  engine_row.kind = FieldKind::group;
  engine_row.member = parameters_of;
  engine_row.child = [fields = &engine.fields]() -> const Table& { return *fields; };
  table.push_back(std::move(engine_row));
  table.push_back(Field<Job>("mesher", &Job::mesher, {.help = "skeleton to mesh, for every engine"}));
  table.push_back(Field<Job>("bark", &Job::bark, {.help = "what the wood is dressed in, for every engine"}));
  table.push_back(Field<Job>("leaves", &Job::leaves, {.help = "leaves on young wood, for every engine"}));
  return table;
}

Job default_job(const AnyEngine& engine) {
  Job job;
  job.name = engine.name;
  job.engine = &engine;
  job.parameters = engine.make_parameters();
  return job;
}

Job independent_copy(const Job& job) {
  Job copy = job;
  if (job.engine) copy.parameters = job.engine->copy_parameters(job.parameters.get());
  return copy;
}

void set_steps(Job& job, int steps) {
  Origins origins;
  assign(job_table(*job.engine), &job, "steps", std::to_string(steps), "steps", origins);
}

void check(Job& job) {
  job.warnings = checked(job, {});
}

Job load_job(const EngineRegistry& registry, const std::string& config, std::span<const Override> overrides) {
  Job job;
  Origins origins;
  job.name = config;
  read_source(registry, find_source(config, {}, {}), 0, job, origins);
  const Table table = job_table(*job.engine);
  for (const Override& o : overrides) assign(table, &job, o.key, o.value, o.flag, origins);
  inherit_from_owners(table, &job, {}, origins);
  job.warnings = checked(job, origins);
  return job;
}

std::string to_toml(const Job& job, bool with_comments) {
  return fmt::format("engine = \"{}\"\n", job.engine->name) +
         to_toml(job_table(*job.engine), &job, {.with_comments = with_comments});
}

Provenance provenance_of(const Job& job) {
  return {version(), job.engine->name, job.seed(), job.steps(), to_toml(job)};
}

}  // namespace ramify
