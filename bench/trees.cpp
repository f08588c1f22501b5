#include "bench/trees.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bench/plain_growth.h"
#include "common/config/job.h"
#include "common/config/presets.h"
#include "growth/engine.h"

namespace ramify::bench {
namespace {

// Exponents and roots are rounded differently where widths are summed in another way.
constexpr double kTolerance = 1e-9;

constexpr std::uint64_t kFnvOffset = 0xcbf29ce484222325;
constexpr std::uint64_t kFnvPrime = 0x100000001b3;

/// FNV-1a over 8 bytes at a time.
template <class T>
void add_to(std::uint64_t& hash, const std::vector<T>& values) {
  const std::size_t bytes = values.size() * sizeof(T);
  const auto* data = reinterpret_cast<const unsigned char*>(values.data());
  for (std::size_t i = 0; i < bytes; i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, data + i, std::min(sizeof word, bytes - i));
    hash = (hash ^ word) * kFnvPrime;
  }
}

}  // namespace

growth::Parameters trial_parameters(const std::vector<std::string>& assignments) {
  EngineRegistry registry;
  growth::register_engine(registry);
  const bool has_own_preset = find_preset("p09-640k") != nullptr;
  std::vector<Override> overrides;
  if (!has_own_preset) overrides.push_back({"bench", "steps", "72"});
  for (const std::string& assignment : assignments) {
    const std::size_t equals = assignment.find('=');
    overrides.push_back({"bench", assignment.substr(0, equals), assignment.substr(equals + 1)});
  }
  const Job job = load_job(registry, has_own_preset ? "p09-640k" : "p09-fig7-50", overrides);
  return *static_cast<const growth::Parameters*>(job.parameters.get());
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

std::uint64_t fingerprint(const Skeleton& skeleton) {
  std::uint64_t hash = kFnvOffset;
  add_to(hash, skeleton.position);
  add_to(hash, skeleton.parent);
  add_to(hash, skeleton.diameter);
  return hash;
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
