// Weights of a graph's edges. Random ones make crooked least-cost paths: the more they vary, the more.
#pragma once

#include <cstdint>

#include "pathplan/domain.h"
#include "pathplan/graph.h"

namespace ramify::pathplan {

/// weight = length^exponent * U(low, high), length in metres.
struct RandomWeights {
  double exponent = 1.0;
  double low = 0.1;
  double high = 1.0;
  std::uint64_t seed = 1;
};

/// Sets graph.weights, one an edge. A weight depends on the seed and the numbers of the edge's ends alone.
/// O(edges) on all threads.
void assign_random_weights(Graph& graph, const RandomWeights& weights);

/// Sets graph.weights to the lengths of the edges, metres. O(edges) on all threads.
void assign_lengths(Graph& graph);

/// Multiplies each edge's weight by the cost factors of the surroundings at its middle. O(edges) on all
/// threads.
void apply_cost_factors(Graph& graph, const Domain& domain);

}  // namespace ramify::pathplan
