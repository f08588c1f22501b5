#include "cli/inputs.h"

#include <fmt/format.h>

#include <filesystem>

#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/base/parallel.h"
#include "common/config/job.h"
#include "common/format/skeleton_files.h"
#include "common/mesh/gltf.h"
#include "common/mesh/mesher.h"
#include "common/skeleton/passes.h"

namespace ramify::cli {
namespace {

Skeleton cut(Skeleton skeleton, const InputFlags& flags, const std::string& input) {
  if (!flags.at_step) return living(skeleton);
  if (skeleton.birth_step.empty()) throw InputError(fmt::format("--at-step: {} has no steps", input));
  return cut_at_step(skeleton, *flags.at_step);
}

Tree meshed(Skeleton skeleton, const MesherOptions& options, const RunFlags& flags) {
  const ThreadLimit limit(flags.threads);
  Tree tree;
  tree.mesh = build_mesh(skeleton, options);
  tree.skeleton = std::move(skeleton);
  return tree;
}

}  // namespace

Tree read_tree(const std::string& input, const InputFlags& flags, const Session& session) {
  const std::string ending = std::filesystem::path(input).extension().string();
  const bool is_mesh = ending == ".glb" || ending == ".gltf";
  const bool is_skeleton = is_skeleton_file(input);
  const std::vector<Override> overrides = flags.configuring.overrides();
  if ((is_mesh || is_skeleton) && !overrides.empty()) {
    throw InputError(fmt::format("{}: {} goes with configs only", overrides.front().flag, input));
  }
  if (is_skeleton) {
    SkeletonFile file = read_skeleton(input, flags.skeleton);
    if (!flags.running.is_quiet) note(file.notes);
    return meshed(cut(std::move(file.skeleton), flags, input), {}, flags.running);
  }
  if (flags.skeleton.up) throw InputError(fmt::format("--up: {} is no skeleton file", input));
  if (is_mesh) {
    if (flags.at_step) throw InputError(fmt::format("--at-step: {} has no steps", input));
    return {std::nullopt, read_gltf(read_file(input), input)};
  }
  const Job job = load_job(session.registry, input, overrides);
  RunContext context;
  context.stop = session.stop;
  context.wants_history = flags.at_step.has_value();
  RunResult run = run_with_progress(job, context, flags.running);
  return meshed(cut(std::move(run.skeleton), flags, input), job.mesher, flags.running);
}

}  // namespace ramify::cli
