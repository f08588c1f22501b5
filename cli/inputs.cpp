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

/// A skeleton and the config that made it, if one did.
struct Grown {
  Skeleton skeleton;
  std::optional<Job> job = {};
};

Grown read_grown(const std::string& input, const InputFlags& flags, const Session& session) {
  const std::vector<Override> overrides = flags.configuring.overrides();
  if (is_skeleton_file(input)) {
    refuse(overrides, input);
    SkeletonFile file = read_skeleton(input, flags.skeleton);
    if (!flags.running.is_quiet) note(file.notes);
    return {living_at(file.skeleton, flags.at_step, input)};
  }
  if (flags.skeleton.up) throw InputError(fmt::format("--up: {} is no skeleton file", input));
  Job job = load_job(session.registry, input, overrides);
  RunContext context;
  context.stop = session.stop;
  context.wants_history = flags.at_step.has_value();
  RunResult run = run_with_progress(job, context, flags.running);
  return {living_at(run.skeleton, flags.at_step, input), std::move(job)};
}

}  // namespace

Skeleton living_at(const Skeleton& skeleton, std::optional<std::uint32_t> step, const std::string& input) {
  if (!step) return living(skeleton);
  if (skeleton.birth_step.empty()) throw InputError(fmt::format("--at-step: {} has no steps", input));
  return cut_at_step(skeleton, *step);
}

bool is_config(const std::string& input) {
  return !is_mesh(input) && !is_skeleton_file(input);
}

Skeleton read_living(const std::string& input, const InputFlags& flags, const Session& session) {
  if (is_mesh(input)) {
    throw InputError(fmt::format("{}: a mesh has no skeleton (a config, a preset or a file ending in {})",
                                 input, skeleton_endings()));
  }
  return read_grown(input, flags, session).skeleton;
}

Tree read_tree(const std::string& input, const InputFlags& flags, const Session& session) {
  if (is_mesh(input)) {
    refuse(flags.configuring.overrides(), input);
    if (flags.skeleton.up) throw InputError(fmt::format("--up: {} is no skeleton file", input));
    if (flags.at_step) throw InputError(fmt::format("--at-step: {} has no steps", input));
    return {std::nullopt, read_gltf(read_file(input), input)};
  }
  Grown grown = read_grown(input, flags, session);
  const ThreadLimit limit(flags.running.threads);
  Tree tree;
  const std::optional<Job>& job = grown.job;
  tree.mesh = make_tree_mesh(grown.skeleton, job ? job->looks() : Looks(), job ? job->seed() : 0).mesh;
  if (job) tree.obstacles = obstacle_mesh(*job);
  for (const std::string& warning : tree.mesh.warnings) warn(warning);
  tree.skeleton = std::move(grown.skeleton);
  return tree;
}

}  // namespace ramify::cli
