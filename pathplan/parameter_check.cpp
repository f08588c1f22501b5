#include "pathplan/parameter_check.h"

#include <fmt/format.h>

#include "common/base/errors.h"
#include "pathplan/poisson_disc.h"

namespace ramify::pathplan {
namespace {

void check_nodes(const Level& level, const std::string& key) {
  check_volume(level.volume, key + ".volume");
  const double nodes =
      wanted_nodes({.nodes = level.nodes, .spacing = level.spacing}, volume_of(level.volume));
  if (nodes > kNodesMax) {
    throw ConfigError(
        "", key + ".spacing",
        fmt::format("{} m makes {} nodes in this volume (at most {})", level.spacing, nodes, kNodesMax));
  }
  if (level.b >= nodes) {
    throw ConfigError(
        "", key + ".b",
        fmt::format("{} endpoints of {} nodes (at most {}: the root is none)", level.b, nodes, nodes - 1));
  }
}

void check_region(const Level& level, const std::string& key) {
  if (level.endpoints == EndpointKind::random) return;
  const Volume region = endpoint_region(level);
  check_volume(region, key + ".region");
  if (shared_volume_of(region, level.volume) > 0.0) return;
  throw ConfigError("", key + ".region",
                    "it has nothing in common with the level's volume (they must overlap)");
}

void check_level(const Level& level, const std::string& key) {
  if (level.sectors != 6 && level.sectors != 8) {
    throw ConfigError("", key + ".sectors", fmt::format("{} (6 or 8)", level.sectors));
  }
  if (level.weight_low > level.weight_high) {
    throw ConfigError("", key + ".weight_low",
                      fmt::format("{} is more than weight_high, {} (at most as much)", level.weight_low,
                                  level.weight_high));
  }
  check_nodes(level, key);
  check_region(level, key);
}

void check_level_count(const Parameters& parameters) {
  const std::size_t count = parameters.levels.size();
  if (count == 0) throw ConfigError("", "levels", "none (at least one level)");
  if (planned_levels(parameters) > count) {
    throw ConfigError("", "steps",
                      fmt::format("{} (there {} {} level{})", parameters.steps, count == 1 ? "is" : "are",
                                  count, count == 1 ? "" : "s"));
  }
  if (planned_levels(parameters) > 1) {
    throw ConfigError("", "levels",
                      fmt::format("{} levels (this version plans one: steps = 1 plans the first)",
                                  planned_levels(parameters)));
  }
}

void check_root(const Volume& volume, const Vec3& root) {
  if (contains(volume, root)) return;
  throw ConfigError("", "root",
                    fmt::format("[{}, {}, {}] is outside the volume of level 1 (inside or on its surface)",
                                root.x, root.y, root.z));
}

}  // namespace

std::vector<std::string> check_parameters(const Parameters& parameters) {
  check_level_count(parameters);
  if (parameters.tip_diameter > parameters.trunk_diameter) {
    throw ConfigError("", "tip_diameter",
                      fmt::format("{} m is more than trunk_diameter, {} m (at most as much)",
                                  parameters.tip_diameter, parameters.trunk_diameter));
  }
  for (std::size_t i = 0; i < planned_levels(parameters); ++i) {
    check_level(parameters.levels[i], fmt::format("levels.{}", i + 1));
  }
  check_root(parameters.levels.front().volume, parameters.root);
  return {};
}

}  // namespace ramify::pathplan
