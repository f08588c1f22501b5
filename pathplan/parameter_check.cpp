#include "pathplan/parameter_check.h"

#include <fmt/format.h>
#include <algorithm>

#include <array>
#include <cmath>
#include <numbers>

#include "common/base/errors.h"
#include "pathplan/poisson_disc.h"
#include "pathplan/subgraph_volume.h"

namespace ramify::pathplan {
namespace {

// Of the threshold graphs of a level; some gigabytes.
constexpr double kEdgesMax = 50e6;

// Nodes are 0.75 (V/K)^(1/3) apart; so many of those within a spacing count to a node, each edge once.
constexpr double kEdgesPerNode = 0.75 * 0.75 * 0.75 * std::numbers::pi * 2.0 / 3.0;

void require_direction(const Vec3& direction, const std::string& key) {
  if (glm::length(direction) >= 1e-6) return;
  throw ConfigError("", key, "its length is 0 (any other length; only where it points counts)");
}

/// Levels of one plan: the tree's or the roots'.
class LevelCheck {
 public:
  /// `most_b` is the greatest share of b that a graph gets.
  LevelCheck(const std::vector<Level>& levels, std::size_t count, std::string key, double most_b)
      : levels_(levels), count_(count), key_(std::move(key)), most_b_(most_b) {}

  void run() {
    for (number_ = 1; number_ <= count_; ++number_) {
      check_choices();
      number_ == 1 ? check_first() : check_later();
      check_sizes();
    }
  }

 private:
  const Level& level() const { return levels_[number_ - 1]; }

  [[noreturn]] void fail(const std::string& key, const std::string& problem) const {
    throw ConfigError("", fmt::format("{}.{}.{}", key_, number_, key), problem);
  }
  std::string key_of(const std::string& key) const { return fmt::format("{}.{}.{}", key_, number_, key); }

  void check_choices() const {
    constexpr std::array kSectors = {6, 8, 14};
    if (std::find(kSectors.begin(), kSectors.end(), level().sectors) == kSectors.end()) {
      fail("sectors", fmt::format("{} (6, 8 or 14)", level().sectors));
    }
    if (level().weight_low > level().weight_high) {
      fail("weight_low", fmt::format("{} is more than weight_high, {} (at most as much)", level().weight_low,
                                     level().weight_high));
    }
  }

  void check_first() {
    cubic_metres_ = check_volume(level().volume, key_of("volume"));
    if (level().endpoints == EndpointKind::manual && level().points.empty()) {
      fail("points", "none, with endpoints = \"manual\" (at least one)");
    }
    if (level().endpoints == EndpointKind::random || level().endpoints == EndpointKind::manual) return;
    const Volume region = endpoint_region(level());
    check_volume(region, key_of("region"));
    if (shared_volume_of(region, level().volume) > 0.0) return;
    fail("region", "it has nothing in common with the level's volume (they must overlap)");
  }

  void check_later() {
    if (level().endpoints == EndpointKind::manual) {
      fail("endpoints", "manual, after level 1 (random | shell | region)");
    }
    if (level().v_g == Orientation::fixed) require_direction(level().v_g_direction, key_of("v_g_direction"));
    const bool is_cone = level().subgraph == SubgraphShape::cone ||
                         level().subgraph == SubgraphShape::inverted_cone ||
                         level().subgraph == SubgraphShape::ellipsoid;
    if (is_cone && level().alpha_deg >= 90.0) {
      fail("alpha_deg", fmt::format("{} of a cone or ellipsoid (less than 90)", level().alpha_deg));
    }
    const Volume volume = subgraph_volume(level(), subgraph_radius(level(), number_));
    if (level().subgraph == SubgraphShape::custom) {
      check_volume(level().volume, key_of("volume"));
      if (!contains(volume, Vec3(0.0))) {
        fail("volume", "the origin is outside (a custom subgraph grows from there along +Y)");
      }
    }
    cubic_metres_ = volume_of(volume);
  }

  /// Of a threshold graph there are the more the farther they reach; a Yao graph's are bounded.
  void check_edges(double nodes) const {
    if (level().edges != EdgeKind::threshold) return;
    const double edges = nodes * kEdgesPerNode * std::pow(level().max_edge, 3.0);
    if (edges <= kEdgesMax) return;
    fail("max_edge", fmt::format("{} spacings make about {:.0f} million edges with edges = \"threshold\" (at "
                                 "most {:.0f} million)",
                                 level().max_edge, edges / 1e6, kEdgesMax / 1e6));
  }

  /// `graphs_` are those of the level, if every endpoint gets one.
  void check_sizes() {
    const double nodes = wanted_nodes({.nodes = level().nodes, .spacing = level().spacing}, cubic_metres_);
    const std::string key = level().spacing > 0.0 ? "spacing" : "nodes";
    if (nodes * graphs_ > kNodesMax) {
      fail(key, number_ == 1 ? fmt::format("{} m makes {} nodes in this volume (at most {})", level().spacing,
                                           nodes, kNodesMax)
                             : fmt::format("{} graphs of {} nodes make {:.0f} (at most {:.0f}; each endpoint "
                                           "of the level before gets a graph)",
                                           graphs_, nodes, nodes * graphs_, kNodesMax));
    }
    check_edges(nodes * graphs_);
    double b = level().endpoints == EndpointKind::manual
                   ? static_cast<double>(level().points.size())
                   : std::round(level().b * (number_ == 1 ? 1.0 : most_b_));
    for (const Stage& stage : level().stages) b += stage.b;
    if (b >= nodes) {
      fail("b", fmt::format("{} endpoints of {} nodes (at most {}: the root is none)", b, nodes, nodes - 1));
    }
    const double endpoints = graphs_ * b;
    total_endpoints_ += endpoints;
    const bool is_around_all = number_ < count_ && levels_[number_].around == Around::all;
    graphs_ = is_around_all ? total_endpoints_ : endpoints;
  }

  const std::vector<Level>& levels_;
  std::size_t count_;
  std::string key_;
  double most_b_;
  std::size_t number_ = 1;  // of the level that is looked at
  double cubic_metres_ = 0.0;
  double graphs_ = 1.0;
  double total_endpoints_ = 0.0;
};

void check_level_count(const Parameters& parameters) {
  const std::size_t count = parameters.levels.size();
  if (count == 0) throw ConfigError("", "levels", "none (at least one level)");
  if (planned_levels(parameters) > count) {
    throw ConfigError("", "steps",
                      fmt::format("{} (there {} {} level{})", parameters.steps, count == 1 ? "is" : "are",
                                  count, count == 1 ? "" : "s"));
  }
}

void check_root(const Volume& volume, const Vec3& root, const std::string& where) {
  if (contains(volume, root)) return;
  throw ConfigError(
      "", "root",
      fmt::format("[{}, {}, {}] is outside {} (inside or on its surface)", root.x, root.y, root.z, where));
}

void check_light(const Parameters& parameters) {
  const Light& light = parameters.light;
  require_direction(light.direction, "light.direction");
  if (light.decrement_low > light.decrement_high) {
    throw ConfigError("", "light.decrement_low",
                      fmt::format("{} is more than decrement_high, {} (at most as much)", light.decrement_low,
                                  light.decrement_high));
  }
  if (light.b_low > light.b_high) {
    throw ConfigError("", "light.b_low",
                      fmt::format("{} is more than b_high, {} (at most as much)", light.b_low, light.b_high));
  }
  if (light.decrement_high > 1 && parameters.lifespan.rule == LifespanRule::distribution) {
    throw ConfigError("", "light.decrement_high",
                      fmt::format("{}, but lifespan.rule = \"distribution\" draws the decrements (1, or the "
                                  "rule \"fixed\")",
                                  light.decrement_high));
  }
}

void check_surroundings(const Parameters& parameters) {
  for (std::size_t i = 0; i < parameters.obstacles.size(); ++i) {
    const std::string key = fmt::format("obstacles.{}.volume", i + 1);
    check_volume(parameters.obstacles[i].volume, key);
    if (contains(parameters.obstacles[i].volume, parameters.root)) {
      throw ConfigError("", key, "the tree's root is inside (obstacles stand beside it)");
    }
  }
  for (std::size_t i = 0; i < parameters.costs.size(); ++i) {
    check_volume(parameters.costs[i].volume, fmt::format("costs.{}.volume", i + 1));
  }
}

void check_refinement(const Parameters& parameters) {
  if (parameters.refine.spheres == 0) return;
  const EndpointKind kind = parameters.levels.front().endpoints;
  if (kind == EndpointKind::manual) {
    throw ConfigError(
        "", "refine.spheres",
        fmt::format("{} with manual endpoints (0, or endpoints in the spheres: random, shell or "
                    "region)",
                    parameters.refine.spheres));
  }
}

}  // namespace

std::vector<std::string> check_parameters(const Parameters& parameters) {
  check_level_count(parameters);
  if (parameters.tip_diameter > parameters.trunk_diameter) {
    throw ConfigError("", "tip_diameter",
                      fmt::format("{} m is more than trunk_diameter, {} m (at most as much)",
                                  parameters.tip_diameter, parameters.trunk_diameter));
  }
  check_light(parameters);
  LevelCheck(parameters.levels, planned_levels(parameters), "levels", parameters.light.b_high).run();
  check_root(parameters.levels.front().volume, parameters.root, "the volume of level 1");
  if (!parameters.roots.empty()) {
    LevelCheck(parameters.roots, parameters.roots.size(), "roots", 1.0).run();
    check_root(parameters.roots.front().volume, parameters.root, "the volume of the roots");
  }
  check_refinement(parameters);
  check_surroundings(parameters);
  return {};
}

}  // namespace ramify::pathplan
