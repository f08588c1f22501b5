#include "cli/inputs.h"

#include <fmt/format.h>

#include <filesystem>

#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/base/parallel.h"
#include "common/config/job.h"
#include "common/format/skeleton_files.h"
#include "common/mesh/gltf.h"
#include "common/mesh/obstacle_mesh.h"
#include "common/mesh/tree_mesh.h"
#include "common/skeleton/passes.h"

namespace ramify::cli {
namespace {

/// Flags that change a config, given for a file that holds a finished tree.
void refuse(const std::vector<Override>& overrides, const std::string& input) {
  if (overrides.empty()) return;
  throw InputError(fmt::format("{}: {} goes with configs only", overrides.front().flag, input));
}

bool is_mesh(const std::string& input) {
  const std::string ending = std::filesystem::path(input).extension().string();
  return ending == ".glb" || ending == ".gltf";
}

}  // namespace

Skeleton living_at(const Skeleton& skeleton, std::optional<std::uint32_t> step, const std::string& input) {
  if (!step) return living(skeleton);
  if (skeleton.birth_step.empty()) throw InputError(fmt::format("--at-step: {} has no steps", input));
  return cut_at_step(skeleton, *step);
}

Grown read_grown(const std::string& input, const InputFlags& flags, bool with_history,
                 const Session& session) {
  const std::vector<Override> overrides = flags.configuring.overrides();
  if (is_skeleton_file(input)) {
    refuse(overrides, input);
    SkeletonFile file = read_skeleton(input, flags.skeleton);
    if (!flags.running.is_quiet) note(file.notes);
    return {std::move(file.skeleton)};
  }
  if (flags.skeleton.up) throw InputError(fmt::format("--up: {} is no skeleton file", input));
  const Job job = load_job(session.registry, input, overrides);
  RunContext context;
  context.stop = session.stop;
  context.wants_history = with_history;
  RunResult run = run_with_progress(job, context, flags.running);
  return {std::move(run.skeleton), job.looks(), job.seed(), obstacle_mesh(job)};
}

bool is_config(const std::string& input) {
  return !is_mesh(input) && !is_skeleton_file(input);
}

Skeleton read_living(const std::string& input, const InputFlags& flags, const Session& session) {
  const Grown grown = read_grown(input, flags, flags.at_step.has_value(), session);
  return living_at(grown.skeleton, flags.at_step, input);
}

Tree read_tree(const std::string& input, const InputFlags& flags, const Session& session) {
  if (is_mesh(input) && flags.configuring.overrides().empty() && !flags.at_step) {
    if (flags.skeleton.up) throw InputError(fmt::format("--up: {} is no skeleton file", input));
    return {std::nullopt, read_gltf(read_file(input), input)};
  }
  Grown grown = read_grown(input, flags, flags.at_step.has_value(), session);
  Tree tree;
  tree.skeleton = living_at(grown.skeleton, flags.at_step, input);
  const ThreadLimit limit(flags.running.threads);
  tree.mesh = make_tree_mesh(*tree.skeleton, grown.looks, grown.seed).mesh;
  for (const std::string& warning : tree.mesh.warnings) warn(warning);
  tree.obstacles = std::move(grown.obstacles);
  return tree;
}

}  // namespace ramify::cli
