#include "cli/experiment/sweep_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/text.h"
#include "common/base/digest.h"
#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/config/file_paths.h"
#include "common/config/provenance.h"

namespace ramify::cli {
namespace {

constexpr const char* kMaker = "ramify sweep";

void check_axes(std::span<const Axis> axes, std::span<const Override> overrides) {
  double runs = 1.0;
  std::set<std::string> keys;
  for (const Axis& axis : axes) {
    if (!keys.insert(axis.key).second) {
      throw InputError(fmt::format("--vary: {}: is there twice (one list of all its values)", axis.key));
    }
    runs *= static_cast<double>(axis.values.size());
  }
  for (const Override& given : overrides) {
    if (keys.count(given.key) == 0) continue;
    throw InputError(fmt::format("{}: {} is varied, too (one of them)", given.flag, given.key));
  }
  if (runs > static_cast<double>(kMaxRuns)) {
    throw InputError(
        fmt::format("--vary: {} combinations (at most {})", short_number(runs), grouped(kMaxRuns)));
  }
}

/// Values of the i-th combination; the last axis varies soonest.
std::vector<std::string> combination(std::span<const Axis> axes, std::size_t i) {
  std::vector<std::string> values(axes.size());
  for (std::size_t k = axes.size(); k-- > 0;) {
    values[k] = axes[k].values[i % axes[k].values.size()];
    i /= axes[k].values.size();
  }
  return values;
}

std::string flags_text(std::span<const Override> overrides) {
  std::string text;
  for (const Override& given : overrides) {
    const std::string value = given.flag == "--set" ? given.key + "=" + given.value : given.value;
    text += fmt::format(" {} {}", given.flag, shell_quoted(value));
  }
  return text;
}

}  // namespace

std::string RunNames::of(const Job& job) {
  std::string text = version() + "\n" + to_toml(job);
  Job copy = independent_copy(job);
  for_each_path(job_table(*copy.engine), &copy, [&](const std::filesystem::path& path) {
    const auto [found, is_new] = digests_.try_emplace(path);
    if (is_new) found->second = digest_of(read_file(path));
    text += "\n" + found->second;
  });
  return digest_of(text);
}

std::string short_key(const std::vector<std::string>& keys, std::size_t at) {
  const auto last = [](const std::string& key) { return key.substr(key.rfind('.') + 1); };
  const auto same = std::count_if(keys.begin(), keys.end(),
                                  [&](const std::string& key) { return last(key) == last(keys[at]); });
  return same > 1 ? keys[at] : last(keys[at]);
}

SweepPlan plan_sweep(const EngineRegistry& registry, const std::string& config,
                     std::span<const Override> overrides, std::span<const Axis> axes) {
  check_axes(axes, overrides);
  SweepPlan plan;
  plan.config = config;
  plan.flags = flags_text(overrides);
  RunNames names;
  std::size_t count = 1;
  for (const Axis& axis : axes) {
    plan.keys.push_back(axis.key);
    count *= axis.values.size();
  }
  std::map<std::vector<std::string>, std::size_t> families;  // by the values of all keys but steps
  for (std::size_t i = 0; i < count; ++i) {
    PlannedRun run;
    run.values = combination(axes, i);
    std::vector<Override> all(overrides.begin(), overrides.end());
    std::vector<std::string> others;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      all.push_back({"--vary", axes[k].key, run.values[k]});
      if (axes[k].key != "steps") others.push_back(run.values[k]);
    }
    Job job = load_job(registry, config, all);
    make_paths_absolute(job_table(*job.engine), &job);
    run.config = to_toml(job);
    run.name = names.of(job);
    run.steps = job.steps();
    if (!job.engine->has_history) others.push_back(std::to_string(i));  // a family of its own
    run.family = families.emplace(others, families.size()).first->second;
    plan.runs.push_back(std::move(run));
  }
  return plan;
}

std::vector<Batch> batches_of(const SweepPlan& plan, std::span<const std::size_t> runs) {
  std::map<std::size_t, std::size_t> place;  // of a family among the batches
  std::set<std::string> names;
  std::vector<Batch> batches;
  for (const std::size_t run : runs) {
    if (!names.insert(plan.runs[run].name).second) continue;
    const auto [found, is_new] = place.emplace(plan.runs[run].family, batches.size());
    if (is_new) batches.emplace_back();
    batches[found->second].push_back(run);
  }
  for (Batch& batch : batches) {
    std::stable_sort(batch.begin(), batch.end(),
                     [&](std::size_t a, std::size_t b) { return plan.runs[a].steps < plan.runs[b].steps; });
  }
  return batches;
}

std::string plan_text(const SweepPlan& plan) {
  nlohmann::ordered_json object = {{"made_by", kMaker},     {"version", version()}, {"command", plan.command},
                                   {"config", plan.config}, {"flags", plan.flags},  {"keys", plan.keys}};
  object["runs"] = nlohmann::ordered_json::array();
  for (const PlannedRun& run : plan.runs) {
    object["runs"].push_back({{"values", run.values},
                              {"run", run.name},
                              {"steps", run.steps},
                              {"family", run.family},
                              {"config", run.config}});
  }
  return object.dump(1) + "\n";
}

bool is_plan(const std::string& text) {
  const nlohmann::json object = nlohmann::json::parse(text, nullptr, false);
  return object.is_object() && object.value("made_by", nlohmann::json()) == kMaker;
}

SweepPlan read_plan(const std::string& text, const std::string& file) {
  try {
    const nlohmann::json object = nlohmann::json::parse(text);
    if (object.at("made_by") != kMaker)
      throw InputError(fmt::format("{}: `{}` did not make it", file, kMaker));
    if (object.at("version") != version()) {
      throw InputError(
          fmt::format("{}: of ramify {}, this is {}", file, object.at("version").dump(), version()));
    }
    SweepPlan plan{object.at("config"), object.at("flags"), object.at("command"), object.at("keys"), {}};
    for (const nlohmann::json& run : object.at("runs")) {
      plan.runs.push_back(
          {run.at("values"), run.at("run"), run.at("config"), run.at("steps"), run.at("family")});
    }
    return plan;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: no plan of a sweep: {}", file, error.what()));
  }
}

}  // namespace ramify::cli
