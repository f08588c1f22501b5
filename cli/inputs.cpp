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

/// Flags that change a config, given for a file that holds a finished tree.
void refuse(const std::vector<Override>& overrides, const std::string& input) {
  if (overrides.empty()) return;
  throw InputError(fmt::format("{}: {} goes with configs only", overrides.front().flag, input));
}

bool is_mesh(const std::string& input) {
  const std::string ending = std::filesystem::path(input).extension().string();
  return ending == ".glb" || ending == ".gltf";
}

/// A skeleton and how its config wants it meshed.
struct Grown {
  Skeleton skeleton;
  MesherOptions mesher;
};

Grown read_grown(const std::string& input, const InputFlags& flags, const Session& session) {
  const std::vector<Override> overrides = flags.configuring.overrides();
  if (std::filesystem::path(input).extension() == ".csv") {
    refuse(overrides, input);
    return {cut(read_skeleton_table(read_file(input), input), flags, input), {}};
  }
  const Job job = load_job(session.registry, input, overrides);
  RunContext context;
  context.stop = session.stop;
  context.wants_history = flags.at_step.has_value();
  RunResult run = run_with_progress(job, context, flags.running);
  return {cut(std::move(run.skeleton), flags, input), job.mesher};
}

}  // namespace

Skeleton read_skeleton(const std::string& input, const InputFlags& flags, const Session& session) {
  if (is_mesh(input)) {
    throw InputError(fmt::format("{}: a mesh has no skeleton (a config, preset or .csv)", input));
  }
  return read_grown(input, flags, session).skeleton;
}

Tree read_tree(const std::string& input, const InputFlags& flags, const Session& session) {
  if (is_mesh(input)) {
    refuse(flags.configuring.overrides(), input);
    if (flags.at_step) throw InputError(fmt::format("--at-step: {} has no steps", input));
    return {std::nullopt, read_gltf(read_file(input), input)};
  }
  Grown grown = read_grown(input, flags, session);
  const ThreadLimit limit(flags.running.threads);
  Tree tree;
  tree.mesh = build_mesh(grown.skeleton, grown.mesher);
  tree.skeleton = std::move(grown.skeleton);
  return tree;
}

}  // namespace ramify::cli
