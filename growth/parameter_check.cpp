#include "growth/parameter_check.h"

#include <fmt/format.h>

#include "common/base/errors.h"

namespace ramify::growth {
namespace {

constexpr double kMinSunElevation = 20.0;  // degrees; lower, shadows would fall many voxels aside

// Beyond these a config asks for more memory than it can mean.
constexpr double kMaxShadedVoxels = 5e7;
constexpr double kMaxMarkers = 5e7;

void check_direction(const Vec3& direction, const std::string& key) {
  if (glm::length(direction) >= 1e-6) return;
  throw ConfigError("", key, "[0, 0, 0] points nowhere (any other vector)");
}

void check_sun(const Parameters& world) {
  check_direction(world.sun_direction, "sun_direction");
  const double elevation = degrees(std::asin(glm::normalize(world.sun_direction).y));
  if (elevation >= kMinSunElevation - 1e-9) return;
  throw ConfigError(
      "", "sun_direction",
      fmt::format("the light is {:.3g} degrees high (at least {})", elevation, kMinSunElevation));
}

/// `prefix` is "" or "trees.N.".
void check_tree(const TreeParameters& tree, const std::string& prefix) {
  for (const auto& [name, tropism] : tree.tropism) {
    const std::string key = fmt::format("{}tropism.{}", prefix, name);
    if (tropism.towards == Towards::direction) check_direction(tropism.direction, key + ".direction");
    if (tropism.min_order > tropism.max_order) {
      throw ConfigError(
          "", key + ".min_order",
          fmt::format("{} is more than max_order (at most {})", tropism.min_order, tropism.max_order));
    }
  }
  for (const auto& [step, w_min] : tree.w_min.points()) {
    if (w_min > tree.w_max.at(step)) {
      throw ConfigError(
          "", prefix + "w_min",
          fmt::format("{} is more than w_max at step {} (at most {})", w_min, step, tree.w_max.at(step)));
    }
  }
}

void check_tree_place(const Parameters& world, const TreePlace& tree, const std::string& prefix) {
  check_tree(tree, prefix);
  if (world.ground && tree.position.y < world.ground_y.at(0)) {
    throw ConfigError("", prefix + "position",
                      fmt::format("its root is below ground (y at least {})", world.ground_y.at(0)));
  }
  for (std::size_t i = 0; i < world.obstacles.size(); ++i) {
    const Obstacle& obstacle = world.obstacles[i];
    if (obstacle.blocks && contains(obstacle.volume, tree.position)) {
      throw ConfigError("", prefix.empty() ? fmt::format("obstacles.{}", i + 1) : prefix + "position",
                        fmt::format("a tree's root stands in obstacle {} (beside it)", i + 1));
    }
  }
}

void check_obstacle(const Obstacle& obstacle, double voxel_edge, const std::string& key) {
  check_volume(obstacle.volume, key + ".volume");
  if (obstacle.shadow <= 0.0) return;
  const Vec3 size = bounds(obstacle.volume).size() / voxel_edge;
  if (size.x * size.y * size.z > kMaxShadedVoxels) {
    throw ConfigError("", key + ".shadow",
                      fmt::format("shadow in a box of {:.3g} voxels (at most {:.3g}: make it smaller, or "
                                  "voxel_size larger)",
                                  size.x * size.y * size.z, kMaxShadedVoxels));
  }
}

void check_markers(const MarkerParameters& markers) {
  check_volume(markers.volume, "markers.volume");
  const double count = markers.density * volume_of(markers.volume);
  if (count <= kMaxMarkers) return;
  throw ConfigError("", "markers.density",
                    fmt::format("{:.3g} markers in the volume (at most {:.3g})", count, kMaxMarkers));
}

/// A tree that cannot even begin.
std::optional<std::string> seed_warning(const Parameters& world, const TreePlace& tree,
                                        const std::string& prefix) {
  const bool is_light = world.environment == Environment::light;
  const double light = is_light ? tree.C.at(1) : 1.0;
  const double vigour = tree.alpha0.at(1) + tree.alpha.at(1) * light;
  if (vigour >= 1.0) return std::nullopt;
  return fmt::format(
      "growth.{}alpha: the tree stays a seed: alpha0 + alpha * {} = {} at step 1 (a shoot takes 1)", prefix,
      is_light ? "C" : "1", vigour);
}

}  // namespace

std::vector<std::string> check_parameters(const Parameters& world) {
  check_sun(world);
  if (world.environment == Environment::space) check_markers(world.markers);
  for (std::size_t i = 0; i < world.obstacles.size(); ++i) {
    check_obstacle(world.obstacles[i], world.voxel_edge(), fmt::format("obstacles.{}", i + 1));
  }
  for (std::size_t i = 0; i < world.prune.size(); ++i) {
    check_volume(world.prune[i].volume, fmt::format("prune.{}.volume", i + 1));
  }

  check_tree(world, "");
  std::vector<std::string> warnings;
  const std::vector<TreePlace> places = world.planted();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::string prefix = world.trees.empty() ? "" : fmt::format("trees.{}.", i + 1);
    check_tree_place(world, places[i], prefix);
    if (const auto warning = seed_warning(world, places[i], prefix)) warnings.push_back(*warning);
  }
  return warnings;
}

}  // namespace ramify::growth
