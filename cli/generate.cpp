#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Option.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/commands.h"
#include "cli/flags.h"
#include "cli/outputs.h"
#include "cli/text.h"
#include "common/base/errors.h"
#include "common/base/memory.h"
#include "common/base/parallel.h"
#include "common/base/stopwatch.h"
#include "common/mesh/tree_mesh.h"
#include "common/skeleton/passes.h"

namespace ramify::cli {
namespace {

struct GenerateFlags {
  std::string config;
  std::vector<std::string> outputs;
  std::string graph;
  std::string shadow;
  std::string lod;
  int at_step = -1;
  bool with_history = false;
  ConfigFlags configuring;
  RunFlags running;
};

std::vector<Output> outputs_of(const GenerateFlags& flags, const Job& job) {
  std::vector<Output> outputs;
  for (const std::string& path : flags.outputs) outputs.push_back(output_of(path));
  if (!flags.shadow.empty()) outputs.push_back({OutputForm::shadow_grid, flags.shadow});
  if (!flags.graph.empty()) outputs.push_back({OutputForm::graph, flags.graph});
  const std::vector<std::string> layers = job.engine->layers(job.parameters.get());
  std::set<std::filesystem::path> seen;
  for (const Output& output : outputs) {
    const std::string layer = output.layer();
    if (!layer.empty() && std::find(layers.begin(), layers.end(), layer) == layers.end()) {
      throw InputError(fmt::format("{}: {} with this config makes no {} (it makes: {})", output.path.string(),
                                   job.engine->name, layer, fmt::join(layers, ", ")));
    }
    for (const std::filesystem::path& file : output.files()) {
      require_writable(file);
      if (!seen.insert(file.lexically_normal()).second) {
        throw InputError(fmt::format("{}: two outputs would write this file", file.string()));
      }
    }
  }
  return outputs;
}

RunContext context_for(const GenerateFlags& flags, const std::vector<Output>& outputs, std::stop_token stop) {
  RunContext context;
  context.stop = std::move(stop);
  context.wants_history = flags.with_history || flags.at_step >= 0;
  for (const Output& output : outputs) {
    if (!output.layer().empty()) context.layers.push_back(output.layer());
  }
  return context;
}

using Seconds = std::vector<std::pair<std::string, double>>;

using Paths = std::vector<std::filesystem::path>;

void print_json(const Results& results, bool has_mesh, const Paths& outputs, const Seconds& seconds) {
  nlohmann::ordered_json object;
  object["engine"] = results.job.engine->name;
  object["preset"] = results.job.name;
  object["seed"] = results.job.seed();
  object["steps"] = results.job.steps();
  object["complete"] = results.run.is_complete;
  object["internodes"] = results.run.skeleton.internode_count();
  object["axes"] = results.run.skeleton.axis_count();
  object["triangles"] = nullptr;
  object["overlay_triangles"] = nullptr;  // of .glb and .gltf, beside those
  if (has_mesh) {
    const std::size_t solid = solid_part(results.tree.mesh).triangle_count;
    object["triangles"] = solid;
    object["overlay_triangles"] = results.tree.mesh.triangles.size() - solid;
  }
  object["leaves"] = nullptr;
  if (results.tree.leaf_count > 0) {
    object["leaves"] = {{"count", results.tree.leaf_count}, {"area", results.tree.leaf_area}};
  }
  for (const auto& [stage, duration] : seconds) object["seconds"][stage] = duration;
  object["peak_memory_bytes"] = process_memory().peak;
  object["outputs"] = nlohmann::json::array();
  for (const auto& file : outputs) object["outputs"].push_back(file.string());
  for (const ReportGroup& group : results.run.report.groups) {
    for (const auto& [name, value] : group.values) {
      const bool is_whole = value == std::floor(value) && std::abs(value) < 1e15;
      if (is_whole) {
        object[group.name][name] = static_cast<std::int64_t>(value);
      } else {
        object[group.name][name] = value;
      }
    }
  }
  fmt::print("{}\n", object.dump());
}

void print_summary(const Results& results, bool has_mesh, const Paths& outputs, const Seconds& seconds) {
  const Job& job = results.job;
  Box box;
  for (const Vec3& position : results.run.skeleton.position) box.include(position);
  fmt::print("{} ({}, seed {}, {} {}): {} internodes, {} axes, {:.3g} m high\n", job.name, job.engine->name,
             job.seed(), job.steps(), job.steps() == 1 ? "step" : "steps",
             grouped(results.run.skeleton.internode_count()), grouped(results.run.skeleton.axis_count()),
             box.size().y);
  for (const ReportGroup& group : results.run.report.groups) {
    fmt::print("{}:", group.name);
    for (const auto& [name, value] : group.values) fmt::print(" {} {:.6g}", name, value);
    fmt::print("\n");
  }
  if (has_mesh) {
    const std::size_t solid = solid_part(results.tree.mesh).triangle_count;
    const std::size_t overlay = results.tree.mesh.triangles.size() - solid;
    const bool has_overlay = overlay > 0;
    fmt::print("{} triangles{}\n", grouped(solid),
               has_overlay ? fmt::format(", and {} of bark over forks in .glb", grouped(overlay)) : "");
  }
  if (results.tree.leaf_count > 0) {
    fmt::print("{} leaves, {:.3g} m2 in all\n", grouped(results.tree.leaf_count), results.tree.leaf_area);
  }
  for (const auto& file : outputs) {
    fmt::print("  {}  {} bytes\n", file.string(), grouped(std::filesystem::file_size(file)));
  }
  double total = 0.0;
  for (const auto& [stage, duration] : seconds) total += duration;
  fmt::print("{:.3f} s (", total);
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    fmt::print("{}{} {:.3f}", i > 0 ? ", " : "", seconds[i].first, seconds[i].second);
  }
  fmt::print("), {:.0f} MB\n", static_cast<double>(process_memory().peak) / 1e6);
}

/// The skeleton as --at-step and --history want it.
Skeleton wanted_state(Skeleton skeleton, const GenerateFlags& flags, const Job& job) {
  if (flags.at_step < 0) return skeleton;
  if (skeleton.birth_step.empty()) {
    throw InputError(fmt::format("--at-step: trees of the engine '{}' have no steps", job.engine->name));
  }
  return cut_at_step(skeleton, static_cast<std::uint32_t>(flags.at_step), flags.with_history);
}

void generate(const GenerateFlags& flags, const Session& session) {
  std::vector<Override> overrides = flags.configuring.overrides();
  if (!flags.lod.empty()) overrides.push_back({"--lod", "mesher.lod", flags.lod});
  Job job = load_job(session.registry, flags.config, overrides);
  if (flags.at_step > job.steps()) {
    throw InputError(
        fmt::format("--at-step: {} is after the last step (0 to {})", flags.at_step, job.steps()));
  }
  const std::vector<Output> outputs = outputs_of(flags, job);
  RunResult run = run_with_progress(job, context_for(flags, outputs, session.stop), flags.running);
  run.skeleton = wanted_state(std::move(run.skeleton), flags, job);

  Stopwatch watch;
  const bool has_mesh =
      std::any_of(outputs.begin(), outputs.end(), [](const Output& o) { return o.needs_mesh(); });
  TreeMesh tree;
  if (has_mesh) {
    const ThreadLimit limit(flags.running.threads);
    tree = make_tree_mesh(living(run.skeleton), job.looks(), job.seed());
    for (const std::string& warning : tree.mesh.warnings) warn(warning);
    watch.lap("mesh");
  }
  if (flags.at_step > 0) set_steps(job, flags.at_step);  // files say how to make what is in them
  const Results results{job, run, tree};
  OutputFiles files;
  for (const Output& output : outputs) write_output(output, results, files);
  if (session.stop.stop_requested()) throw Interrupted();
  const Paths written = files.paths();
  files.commit();
  if (!outputs.empty()) watch.lap("files");

  Seconds seconds = run.report.seconds;
  seconds.insert(seconds.end(), watch.seconds().begin(), watch.seconds().end());
  if (flags.running.is_json) {
    print_json(results, has_mesh, written, seconds);
  } else if (!flags.running.is_quiet) {
    print_summary(results, has_mesh, written, seconds);
  }
}

}  // namespace

void add_generate(CLI::App& program, const Session& session) {
  auto flags = std::make_shared<GenerateFlags>();
  CLI::App* command = program.add_subcommand("generate", "Make a tree and write it to files");
  command
      ->add_option("config", flags->config,
                   "A preset (`ramify presets`), a TOML file, or a .glb, .gltf or .skel.ply that ramify made")
      ->type_name("CONFIG")
      ->required();
  command
      ->add_option(
          "-o,--output", flags->outputs,
          "File to write, by its ending: .glb .gltf .obj .ply .stl mesh, .csv .skel.ply .swc .mtg skeleton, "
          ".pov scene, .png picture, .vdb shadow (repeatable)")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->add_option("--at-step", flags->at_step, "The tree as it was after step K")
      ->type_name("K")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--lod", flags->lod, "Level of detail of the mesh, 0 (all of it) to 3")->type_name("N");
  command->add_flag("--history", flags->with_history,
                    "Growth: shed internodes too go into the skeleton table");
  command->add_option("--graph", flags->graph, "Pathplan: write the graph's edges here, its nodes beside it")
      ->type_name("FILE.csv");
  command->add_option("--shadow", flags->shadow, "Growth: write the shadow grid")->type_name("FILE.vdb");
  flags->configuring.add_to(*command);
  flags->running.add_to(*command);
  command->callback([flags, &session] { generate(*flags, session); });
}

}  // namespace ramify::cli
