// Nodes in a Poisson-disc distribution: random, but no two nearer than a given distance.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012, Fig.
// 4, 1A-1F.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <vector>

#include "common/base/geometry.h"
#include "common/volume/volume.h"

namespace ramify::pathplan {

/// What is wanted: a number of nodes, or the distance from which that follows.
struct Scatter {
  int nodes = 1000;      // K, the root included; not read if spacing > 0
  double spacing = 0.0;  // d, metres; 0: 0.75 (V/K)^(1/3), less if that many do not fit
  std::uint64_t seed = 1;
};

struct Nodes {
  std::vector<Vec3> position;  // metres; the root first, the others in the order of cells, near ones together
  double spacing = 0.0;        // metres; no two nodes are nearer
};

/// How many nodes a volume of `cubic_metres` gets at `spacing`, or `scatter.nodes` where that is 0.
double wanted_nodes(const Scatter& scatter, double cubic_metres);

/// Exactly scatter.nodes nodes inside `volume`, `root` among them, or as many as its spacing makes (fewer
/// only where they do not fit). Calls progress(nodes so far, nodes wanted) before each pass. A stop request
/// ends it after a pass with the nodes that it has. Throws RunError if the volume fills too little of its box
/// for the grid. O(nodes).
Nodes scatter_nodes(const Volume& volume, const Vec3& root, const Scatter& scatter, std::stop_token stop = {},
                    const std::function<void(double done, double total)>& progress = {});

}  // namespace ramify::pathplan
