#include "pathplan/endpoints.h"

#include <fmt/format.h>

#include "common/base/errors.h"
#include "common/base/rng.h"

namespace ramify::pathplan {
namespace {

/// Nodes but the root for which is_wanted is true.
template <class Wanted>
std::vector<std::uint32_t> candidates(std::span<const Vec3> nodes, const Wanted& is_wanted) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t node = 1; node < nodes.size(); ++node) {
    if (is_wanted(nodes[node])) found.push_back(node);
  }
  return found;
}

std::vector<std::uint32_t> candidates(std::span<const Vec3> nodes, const Level& level) {
  if (level.endpoints == EndpointKind::random) return candidates(nodes, [](const Vec3&) { return true; });
  const Solid region(endpoint_region(level));
  if (level.endpoints == EndpointKind::region) {
    return candidates(nodes, [&](const Vec3& node) { return region.contains(node); });
  }
  return candidates(nodes, [&](const Vec3& node) {
    return region.contains(node) && region.outer_depth(node) <= level.shell_thickness;
  });
}

std::string place(const Level& level) {
  switch (level.endpoints) {
    case EndpointKind::random:
      return "beside the root";
    case EndpointKind::region:
      return "in the region";
    case EndpointKind::shell:
      return fmt::format("in the shell of {} m", level.shell_thickness);
  }
  return {};
}

}  // namespace

std::vector<std::uint32_t> choose_endpoints(std::span<const Vec3> nodes, const Level& level,
                                            std::uint64_t seed) {
  std::vector<std::uint32_t> chosen = candidates(nodes, level);
  const auto wanted = static_cast<std::size_t>(level.b);
  if (chosen.size() < wanted) {
    throw RunError(
        fmt::format("b: {} endpoints wanted, {} nodes {} (more nodes, fewer endpoints or a larger place)",
                    wanted, chosen.size(), place(level)));
  }
  // The first steps of Fisher and Yates's shuffle.
  Rng rng = Rng::stream(seed, Stream::endpoint, 0);
  for (std::size_t i = 0; i < wanted; ++i) std::swap(chosen[i], chosen[i + rng.below(chosen.size() - i)]);
  chosen.resize(wanted);
  return chosen;
}

}  // namespace ramify::pathplan
