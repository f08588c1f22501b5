// One graph and the branches planned in it: a call of Maketree, without what follows around its endpoints.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012, Fig.
// 4, steps 1 to 3.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <string_view>
#include <vector>

#include "common/volume/solid.h"
#include "pathplan/domain.h"
#include "pathplan/graph.h"
#include "pathplan/guiding.h"
#include "pathplan/parameters.h"
#include "pathplan/poisson_disc.h"
#include "pathplan/refined_crown.h"

namespace ramify::pathplan {

/// What all graphs of one level that are alike share; each is placed by a Frame.
struct Pattern {
  /// Of a level's row. `volume` and `root` are in the graph's own frame. `obstructed` is how much of the
  /// volume obstacles take, cubic metres. Throws RunError if that is nearly all of it.
  Pattern(const Level& level, const Volume& volume, const Vec3& root, double obstructed = 0.0);

  const Level& row;
  Solid solid;
  double cubic_metres;      // that nodes may fill
  std::vector<Vec3> seeds;  // what becomes a node wherever it is: the root, then manual endpoints
  PoissonDisc poisson_disc;
};

/// One graph to plan in.
struct Site {
  Frame frame = {};
  Vec3 axis = kUp;  // what guiding vectors begin with, in the graph's frame; unit
  int b = 1;        // endpoints
  std::uint64_t seed = 1;
  const Solid* region = nullptr;        // where endpoints of kinds shell and region are; none: everywhere
  const RefinedCrown* crown = nullptr;  // the volume is that of a refined crown
  bool must_be_complete = true;         // else what does not fit is left out: nodes, endpoints
};

struct GraphCounts {
  std::size_t graphs = 0;
  std::size_t nodes = 0;
  std::size_t edges = 0;
  std::size_t endpoints = 0;
  std::size_t unreachable = 0;  // endpoints

  void add(const GraphCounts& other);
};

/// A tree of branches without widths; node 0 is the graph's root.
struct Branching {
  std::vector<Vec3> position;         // metres, in the world; parents first
  std::vector<std::uint32_t> parent;  // kNoParent for the root
  std::vector<std::uint32_t> tips;    // the endpoints that are reached
  GraphCounts counts;
};

/// The graph itself, for level 1: layers and statistics are made from it.
struct PlannedGraph {
  Graph graph;
  std::vector<std::uint32_t> subvolumes;  // of each node; none: all 0
  std::vector<Guide> guides;              // of each node; none: random weights
  // With guides, what each edge costs from its first node to its second, and back.
  std::vector<std::array<double, 2>> guided_costs;
  double edge_length = 0.0;     // mean, metres
  std::size_t components = 1;   // sets of nodes that edges connect
  std::size_t unreachable = 0;  // endpoints
};

/// What the caller hears of one graph's making.
struct BranchingHooks {
  std::stop_token stop = {};
  std::function<void(double done, double total)> on_nodes = {};
  std::function<void(std::string_view finished)> on_stage = {};  // "nodes", "graph", "paths"
  PlannedGraph* graph = nullptr;                                 // where to leave the graph
  bool wants_guided_costs = false;                               // in there
};

/// Nodes, edges, weights, least-cost paths, endpoints and the union of their paths. A stop request leaves it
/// unfinished. Throws RunError if nodes or endpoints do not fit; unreachable endpoints are counted and left
/// out. About linear in the nodes.
Branching plan_branching(const Pattern& pattern, const Site& site, const Surroundings& surroundings,
                         const BranchingHooks& hooks = {});

}  // namespace ramify::pathplan
