// The path-planning engine: a tree is the union of least-cost paths, in a randomly weighted graph, from
// endpoints to one root.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/config/engine.h"
#include "pathplan/parameters.h"

namespace ramify::pathplan {

struct Engine {
  using Parameters = pathplan::Parameters;
  static constexpr std::string_view name = "pathplan";
  static std::vector<std::string> layers(const Parameters&) { return {"graph", "endpoints"}; }

  /// How many levels are planned.
  static int steps(const Parameters& parameters) { return static_cast<int>(planned_levels(parameters)); }

  /// Throws ConfigError for what one range cannot say, with keys such as "levels.1.sectors". Looks into the
  /// volumes on a grid: some milliseconds.
  static std::vector<std::string> check(const Parameters& parameters);

  /// `parameters` have passed check(). Stages: nodes, graph, paths, tree. Layers: "graph" (a line an edge
  /// with its weight, a point a node with the number of its subvolume) and "endpoints". Throws RunError where
  /// there are too few nodes for the endpoints or an endpoint cannot be reached. About linear in the nodes.
  /// A run that is stopped returns a root without internodes.
  static RunResult run(const Parameters& parameters, const RunContext& context);
};

void register_engine(EngineRegistry& registry);

}  // namespace ramify::pathplan
