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

}  // namespace

growth::Parameters trial_parameters(const std::vector<std::string>& assignments) {
  if (find_preset("p09-640k")) return preset_parameters<growth::Engine>("p09-640k", assignments);
  std::vector<std::string> as_large = {"steps=72"};
  as_large.insert(as_large.end(), assignments.begin(), assignments.end());
  return preset_parameters<growth::Engine>("p09-fig7-50", as_large);
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
  if (trial.work == kPlain) {
    PlainTree tree(parameters);
    Outcome outcome = measured([&] { tree.grow(); });
    outcome.count = static_cast<double>(tree.internode_count());
    return outcome;
  }
  RunResult result;
  Outcome outcome = measured([&] { result = growth::Engine::run(parameters, {}); });
  if (!result.is_complete) throw RunError(result.report.warnings.front());
  outcome.count = static_cast<double>(result.skeleton.internode_count());
  outcome.skeleton = fingerprint(result.skeleton);
  return outcome;
}

std::optional<std::string> plain_difference(const std::vector<int>& steps) {
  for (const int count : steps) {
    const growth::Parameters parameters = trial_parameters({fmt::format("steps={}", count)});
    const Skeleton grown = growth::Engine::run(parameters, {}).skeleton;
    PlainTree plain(parameters);
    plain.grow();
    if (const auto found = difference(grown, plain.skeleton(), kTolerance)) {
      return fmt::format("growth/ and the plain version differ after {} steps: {}", count, *found);
    }
    fmt::print("{} steps: growth/ and the plain version make the same {} internodes\n", count,
               grown.internode_count());
  }
  return std::nullopt;
}

}  // namespace ramify::bench
