// Level upon level: graphs around the endpoints of graphs.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012, 3.2,
// Fig. 4, step 4.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/stopwatch.h"
#include "common/config/engine.h"
#include "common/skeleton/skeleton.h"
#include "pathplan/branching.h"
#include "pathplan/parameters.h"

namespace ramify::pathplan {

/// Levels that are planned upon each other from one root.
struct LevelPlan {
  std::span<const Level> levels;
  Vec3 axis = kUp;  // where the tree goes to, unit
  Refinement refine = {};
  Lifespan lifespan = {};
  Light light = {};
  std::uint64_t seed = 1;
};

/// An endpoint in the tree.
struct Tip {
  std::uint32_t node;
  Vec3 origin;          // the root of its own graph, metres
  int lifespan;         // how many levels may follow; until the level is done, that of its graph's root
  double b_factor = 1;  // of the endpoints of the graph around it
};

/// A tree without widths and axes.
struct PlannedTree {
  Skeleton skeleton;                   // positions, parents, levels; node 0 is the root
  std::vector<std::vector<Tip>> tips;  // by level
  GraphCounts counts;                  // of all graphs
  PlannedGraph first;                  // the graph of level 1
  bool is_complete = true;             // false: stopped; levels that are not whole are left out
};

/// Plans them in turn; the graphs of a level on all threads. Reports progress and laps "nodes", "graph" and
/// "paths" for level 1, then "levels". Throws RunError as plan_branching() does. About linear in the nodes
/// of all graphs.
PlannedTree plan_levels(const LevelPlan& plan, const Vec3& root, const Surroundings& surroundings,
                        const RunContext& context, Stopwatch& watch);

}  // namespace ramify::pathplan
