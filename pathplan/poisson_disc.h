// Nodes in a Poisson-disc distribution: random, but no two nearer than a given distance.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012, Fig.
// 4, 1A-1F.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <vector>

#include "common/base/geometry.h"
#include "pathplan/dart_grid.h"
#include "pathplan/domain.h"

namespace ramify::pathplan {

/// How many nodes are wanted, or the distance from which that follows.
struct Scatter {
  int nodes = 1000;      // K, the root included; not read if spacing > 0
  double spacing = 0.0;  // d, metres; 0: 0.75 (V/K)^(1/3), less if that many do not fit
};

struct Nodes {
  std::vector<Vec3> position;  // metres; the root first, the others in the order of cells, near ones together
  double spacing = 0.0;        // metres; no two nodes are nearer
};

/// How many nodes a volume of `cubic_metres` gets at `spacing`, or `scatter.nodes` where that is 0.
double wanted_nodes(const Scatter& scatter, double cubic_metres);

/// d where `scatter` does not say it.
double wanted_spacing(const Scatter& scatter, double cubic_metres);

/// Spreads nodes over volumes of one shape and size, in whatever frames.
class PoissonDisc {
 public:
  /// `cubic_metres` is the solid's volume, or what obstacles leave of it; `roots` will be nodes.
  /// Throws RunError if the solid fills too little of its box for the grid.
  PoissonDisc(const Solid& solid, const Scatter& scatter, double cubic_metres, std::span<const Vec3> roots);

  /// The roots (first; those nearer than the spacing to an earlier one are left out) and random nodes in the
  /// domain, whose solid is that of the constructor: exactly as many as are wanted in all. Fewer only where
  /// the spacing was given or `may_shrink` is false, and they do not fit; else the spacing is made less.
  /// Calls progress(nodes so far, nodes wanted) before each pass. A stop request ends it after a pass with
  /// the nodes that it has. O(nodes) on all threads.
  Nodes scatter(const Domain& domain, std::span<const Vec3> roots, bool may_shrink, std::uint64_t seed,
                const std::stop_token& stop = {},
                const std::function<void(double done, double total)>& progress = {}) const;

 private:
  std::size_t wanted_;
  bool is_spacing_given_;
  Box box_;
  DartGrid grid_;
};

/// The same for a single volume in the world, without obstacles.
Nodes scatter_nodes(const Volume& volume, const Vec3& root, const Scatter& scatter, std::uint64_t seed = 1);

}  // namespace ramify::pathplan
