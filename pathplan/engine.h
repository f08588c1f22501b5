// The path-planning engine: a tree is the union of least-cost paths, in weighted graphs, from endpoints to
// one root; level upon level.
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
  static constexpr bool has_history = false;
  static std::vector<std::string> layers(const Parameters& parameters);

  /// Those of level 1 and of the surroundings: later levels' are about each of their endpoints anew.
  static UsedVolumes volumes(const Parameters& parameters);

  /// How many levels are planned.
  static int steps(const Parameters& parameters) { return static_cast<int>(planned_levels(parameters)); }

  /// Throws ConfigError for what one range cannot say, with keys such as "levels.1.sectors". Looks into the
  /// volumes on a grid: some milliseconds a level.
  static std::vector<std::string> check(const Parameters& parameters);

  /// `parameters` have passed check(). Stages: nodes, graph, paths (of level 1), levels (the later ones),
  /// roots, tree. Report: "graph" (of level 1) and "all_graphs". Layers, of level 1: "graph" (a line an edge
  /// with its weight, with guiding vectors one each way; a point a node with the number of its subvolume),
  /// "endpoints" (of all levels) and, with guiding vectors, "guiding". Throws RunError where there are too
  /// few nodes for the endpoints or, unless that is only to be warned of, an endpoint cannot be reached.
  /// About linear in the nodes of all graphs. A run that is stopped returns the tree of the levels that are
  /// whole.
  static RunResult run(const Parameters& parameters, const RunContext& context);
};

void register_engine(EngineRegistry& registry);

}  // namespace ramify::pathplan
