#include "cli/inputs.h"

#include <fmt/format.h>

#include <filesystem>

#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/base/parallel.h"
#include "common/config/job.h"
#include "common/format/skeleton_table.h"
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

bool is_config(const std::string& input) {
  const std::string ending = std::filesystem::path(input).extension().string();
  return ending != ".csv" && ending != ".glb" && ending != ".gltf";
}

Tree read_tree(const std::string& input, const InputFlags& flags, const Session& session) {
  const std::string ending = std::filesystem::path(input).extension().string();
  const bool is_file = !is_config(input);
  const std::vector<Override> overrides = flags.configuring.overrides();
  if (is_file && !overrides.empty()) {
    throw InputError(fmt::format("{}: {} goes with configs only", overrides.front().flag, input));
  }
  if (ending == ".csv") {
    return meshed(cut(read_skeleton_table(read_file(input), input), flags, input), {}, flags.running);
  }
  if (is_file) {
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
