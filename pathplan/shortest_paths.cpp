#include "pathplan/shortest_paths.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/skeleton/skeleton.h"
#include "pathplan/bucket_queue.h"

namespace ramify::pathplan {
namespace {

// In mean weights. Narrower buckets are mostly empty; in wider ones more nodes are looked at again.
constexpr double kBucketWidth = 0.12;

}  // namespace

ShortestPaths unsearched_paths(std::size_t nodes, std::span<const std::uint32_t> sources) {
  ShortestPaths paths{.cost = std::vector<double>(nodes, kUnreached),
                      .parent = std::vector<std::uint32_t>(nodes, kNoParent)};
  for (const std::uint32_t source : sources) paths.cost[source] = 0.0;
  return paths;
}

ShortestPaths shortest_paths(const Graph& graph, std::span<const std::uint32_t> sources,
                             std::stop_token stop) {
  ShortestPaths paths = unsearched_paths(graph.nodes.size(), sources);
  if (graph.weights.empty()) return paths;
  const double mean = std::accumulate(graph.weights.begin(), graph.weights.end(), 0.0) /
                      static_cast<double>(graph.weights.size());
  const double heaviest = *std::max_element(graph.weights.begin(), graph.weights.end());
  BucketQueue<QueueOrder::rough> queue(std::max(kBucketWidth * mean, heaviest / kBucketsMax), heaviest);
  for (const std::uint32_t source : sources) queue.push(0.0, source);

  while (!queue.is_empty() && !stop.stop_requested()) {
    const auto [cost_here, node] = queue.pop();
    if (cost_here > paths.cost[node]) continue;  // a better way was found since
    for (const Link& link : graph.links_of(node)) {
      double cost = cost_here + link.weight;
      // A weight too small to count still counts, so that parents come before their children.
      if (cost == cost_here) cost = std::nextafter(cost, kUnreached);
      if (cost >= paths.cost[link.node]) continue;
      paths.cost[link.node] = cost;
      paths.parent[link.node] = node;
      queue.push(cost, link.node);
    }
  }
  return paths;
}

}  // namespace ramify::pathplan
