#include "pathplan/weights.h"

#include <algorithm>

#include "common/base/parallel.h"
#include "common/base/rng.h"

namespace ramify::pathplan {
namespace {

// Edges a task.
constexpr std::size_t kGrain = 4096;

}  // namespace

void assign_random_weights(Graph& graph, const RandomWeights& weights) {
  graph.weights.resize(graph.edges.size());
  parallel_for(graph.edges.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto [a, b] = graph.edges[i];
      Rng rng = Rng::stream(weights.seed, Stream::edge_weight, std::min(a, b), std::max(a, b));
      const double length = glm::distance(graph.nodes[a], graph.nodes[b]);
      const double scale = weights.exponent == 1.0 ? length : std::pow(length, weights.exponent);
      graph.weights[i] = static_cast<float>(scale * rng.uniform(weights.low, weights.high));
    }
  });
}

void assign_lengths(Graph& graph) {
  graph.weights.resize(graph.edges.size());
  parallel_for(graph.edges.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto [a, b] = graph.edges[i];
      graph.weights[i] = static_cast<float>(glm::distance(graph.nodes[a], graph.nodes[b]));
    }
  });
}

void apply_cost_factors(Graph& graph, const Domain& domain) {
  parallel_for(graph.edges.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto [a, b] = graph.edges[i];
      const double factor = domain.cost_factor(0.5 * (graph.nodes[a] + graph.nodes[b]));
      graph.weights[i] *= static_cast<float>(factor);
    }
  });
}

}  // namespace ramify::pathplan
