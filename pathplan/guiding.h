// Guiding vectors: each node has a unit vector that makes edges along it cheap, so that paths follow it. A
// node's vector is its parent's, turned; it is known when the node's path is.
// L. Xu and D. Mould, Procedural tree modeling with guiding vectors, Computer Graphics Forum 34(7), 2015
// (incremental); L. Xu, Three-dimensional irregular tree modeling for special virtual environments, 2018
// (periodic).
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "common/base/geometry.h"
#include "common/base/rng.h"
#include "pathplan/graph.h"
#include "pathplan/parameters.h"
#include "pathplan/shortest_paths.h"

namespace ramify::pathplan {

/// What an edge costs: weight * (1 - cosine to the guiding vector + epsilon).
struct GuidedCost {
  double across;          // of a unit of weight across the vector: 1 + epsilon
  bool has_cost_factors;  // else a weight is a length

  double operator()(const Vec3& vector, const Vec3& way, double weight) const {
    const double factor = has_cost_factors ? weight / glm::length(way) : 1.0;
    return weight * across - factor * glm::dot(vector, way);
  }
};

struct Guide {
  Vec3 vector{0.0};     // unit; 0 where the node was not reached
  double progress = 0;  // incremental: radians turned in all; periodic: metres walked since the last turn
};

/// The guiding vectors of one graph, kept from one search to the next.
class GuidedSearch {
 public:
  /// The root, node 0, is guided along `axis` (unit), the middle of the trunk; `spacing` of the nodes in
  /// metres. A weight of the graph is an edge's length times its cost factor, if there are factors: an edge
  /// from u along e costs weight * (1 - g_u . e + epsilon). `graph` is looked at later: it must outlive the
  /// search. O(edges).
  GuidedSearch(const Graph& graph, const Level& level, double spacing, const Vec3& axis, std::uint64_t seed,
               bool has_cost_factors = false);

  /// Least-cost paths from the sources, which must have been reached before (or be the root) and keep their
  /// vectors; all others get new ones. Paths are those of a search that settles nodes by rising cost, equal
  /// ones by the lower number. About O(edges).
  ShortestPaths paths_from(std::span<const std::uint32_t> sources, std::stop_token stop = {});

  const std::vector<Guide>& guides() const { return guides_; }
  /// Mean, metres.
  double edge_length() const { return edge_length_; }

  /// What the edge from one node to another costs by the vectors as they are.
  double cost(std::uint32_t from, std::uint32_t to, double weight) const {
    return cost_(guides_[from].vector, graph_.nodes[to] - graph_.nodes[from], weight);
  }

 private:
  template <class Queue>
  ShortestPaths search(Queue queue, std::span<const std::uint32_t> sources, const std::stop_token& stop);
  void set_guide(std::uint32_t node, std::uint32_t parent);
  void turn_outwards(Guide& guide, std::uint32_t node, double way) const;
  void turn_by_periods(Guide& guide, std::uint32_t node, double way) const;
  double periodic_angle(std::uint32_t node, Rng& rng) const;
  double value_at(const Schedule& schedule, std::uint32_t node) const;

  const Graph& graph_;
  const Guiding& guiding_;
  bool is_periodic_;
  GuidedCost cost_;
  double spacing_;  // metres
  Vec3 axis_;
  std::uint64_t seed_;
  double edge_length_ = 0.0;
  double cheapest_ = 0.0;  // no edge costs less
  double heaviest_ = 0.0;  // or more
  double farthest_ = 0.0;  // distance of a node from the root, metres
  std::vector<Guide> guides_;
};

}  // namespace ramify::pathplan
