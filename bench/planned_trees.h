// The trees that are planned to be measured, and the nodes that graphs are made of.
#pragma once

#include <string>
#include <vector>

#include "bench/lone_run.h"
#include "common/volume/solid.h"
#include "pathplan/domain.h"
#include "pathplan/graph.h"
#include "pathplan/poisson_disc.h"
#include "pathplan/weights.h"

namespace ramify::bench {

/// One graph in the volume of XM12 Fig. 5, with an endpoint to 22 nodes as in its Fig. 22.
Trial one_graph_trial(int nodes);

/// XM12 Table 1's tree of 351,810 nodes and 34,740 endpoints, on four levels.
Trial four_level_trial(int threads);

/// Plans the tree of a trial, whose work is the name of a preset, and measures that.
Outcome plan(const Trial& trial);

/// The volume of XM12 Fig. 5 with nodes in it.
struct Mushroom {
  explicit Mushroom(int count);
  Mushroom(const Mushroom&) = delete;  // the domain looks at what is beside it
  Mushroom& operator=(const Mushroom&) = delete;

  Volume volume;
  Solid solid;
  pathplan::Surroundings surroundings;  // nothing
  pathplan::Domain domain;
  pathplan::Nodes nodes;

  /// The engine's default Yao graph of its nodes in the order given, with random weights.
  pathplan::Graph graph(std::vector<Vec3> positions, int sectors = 8) const;

  /// At most so many metres long, inside the volume.
  std::vector<pathplan::Edge> edges_within(double metres) const;
};

/// The rule that all graphs here are weighted by.
inline constexpr pathplan::RandomWeights kWeights{.low = 0.2, .high = 1.0};

}  // namespace ramify::bench
