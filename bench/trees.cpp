#include "bench/trees.h"

#include <fmt/format.h>

#include <cmath>

#include "bench/fingerprint.h"
#include "bench/plain_growth.h"
#include "bench/preset_parameters.h"
#include "common/base/errors.h"
#include "common/config/presets.h"
#include "growth/engine.h"

namespace ramify::bench {
namespace {

// Exponents and roots are rounded differently where widths are summed in another way.
constexpr double kTolerance = 1e-9;

/// Voxels each way of a dense field that an unshed tree stays in.
int dense_voxels(const growth::Parameters& parameters) {
  return 6 * parameters.steps;
}

PlainTree plain_tree(const growth::Parameters& parameters, bool is_dense) {
  return is_dense ? PlainTree(parameters, dense_voxels(parameters)) : PlainTree(parameters);
}

/// The first difference between what growth/ and a plain version make.
std::optional<std::string> plain_difference(const std::vector<std::string>& assignments, bool is_dense) {
  const growth::Parameters parameters = trial_parameters(assignments);
  const Skeleton grown = growth::Engine::run(parameters, {}).skeleton;
  PlainTree plain = plain_tree(parameters, is_dense);
  plain.grow();
  const char* const version = is_dense ? "the plain version in a dense field" : "the plain version";
  if (const auto found = difference(grown, plain.skeleton(), kTolerance)) {
    return fmt::format("growth/ and {} differ after {} steps: {}", version, parameters.steps, *found);
  }
  fmt::print("{} steps: growth/ and {} make the same {} internodes\n", parameters.steps, version,
             grown.internode_count());
  return std::nullopt;
}

}  // namespace

growth::Parameters trial_parameters(const std::vector<std::string>& assignments) {
  if (find_preset("p09-640k")) return preset_parameters<growth::Engine>("p09-640k", assignments);
  std::vector<std::string> as_large = {"steps=72"};
  as_large.insert(as_large.end(), assignments.begin(), assignments.end());
  return preset_parameters<growth::Engine>("p09-fig7-50", as_large);
}

std::vector<std::string> unshed_assignments(int steps) {
  return {fmt::format("steps={}", steps),
          "growth.shed_threshold=0",
          "growth.max_metamers=0",
          "growth.optimal_from=gradient",
          "growth.v_per=shoot",
          "growth.C=2.5",
          "growth.a=0.8",
          "growth.b=1.2247449",
          "growth.q_max=6",
          "growth.w_optimal=0.1",
          "growth.tropism.up.weight=0.02",
          "growth.branching_angle_deg=45",
          "growth.divergence_deg=90"};
}

std::optional<std::string> difference(const Skeleton& a, const Skeleton& b, double tolerance) {
  if (a.node_count() != b.node_count()) {
    return fmt::format("{} nodes in one, {} in the other", a.node_count(), b.node_count());
  }
  for (std::size_t node = 0; node < a.node_count(); ++node) {
    if (a.parent[node] != b.parent[node]) {
      return fmt::format("node {}: parent {} in one, {} in the other", node, a.parent[node], b.parent[node]);
    }
    const double apart = glm::length(a.position[node] - b.position[node]);
    if (!(apart <= tolerance)) return fmt::format("node {}: {} m apart", node, apart);
    if (!(std::abs(a.diameter[node] - b.diameter[node]) <= tolerance)) {
      return fmt::format("node {}: diameter {} m in one, {} m in the other", node, a.diameter[node],
                         b.diameter[node]);
    }
  }
  return std::nullopt;
}

Outcome grow(const Trial& trial) {
  const growth::Parameters parameters = trial_parameters(trial.assignments);
  if (trial.work == kPlain || trial.work == kDense) {
    PlainTree tree = plain_tree(parameters, trial.work == kDense);
    Outcome outcome = measured([&] { tree.grow(); });
    outcome.count = static_cast<double>(tree.internode_count());
    return outcome;
  }
  if (trial.work != kGrowth) throw RunError(fmt::format("no work {}", trial.work));
  RunResult result;
  Outcome outcome = measured([&] { result = growth::Engine::run(parameters, {}); });
  if (!result.is_complete) throw RunError(result.report.warnings.front());
  outcome.count = static_cast<double>(result.skeleton.internode_count());
  outcome.skeleton = fingerprint(result.skeleton);
  return outcome;
}

std::optional<std::string> plain_difference(const std::vector<int>& steps) {
  for (const int count : steps) {
    if (auto found = plain_difference({fmt::format("steps={}", count)}, false)) return found;
    if (auto found = plain_difference(unshed_assignments(count), true)) return found;
  }
  return std::nullopt;
}

}  // namespace ramify::bench
