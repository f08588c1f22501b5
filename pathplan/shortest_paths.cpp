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

// In buckets as wide as several light edges a node is looked at again and again: order within them is worth
// its price then.
constexpr double kRoughUpTo = 4.0;

// Nodes that are asked for the weight of light edges.
constexpr std::size_t kAsked = 1000;

/// What the lightest edge of a node weighs: the harmonic mean over some nodes, so that places where all edges
/// are light count.
double light_weight(const Graph& graph) {
  double sum = 0.0;  // of inverses
  std::size_t count = 0;
  for (std::size_t node = 0; node < graph.nodes.size(); node += 1 + graph.nodes.size() / kAsked) {
    const std::span<const Link> links = graph.links_of(static_cast<std::uint32_t>(node));
    if (links.empty()) continue;
    const auto is_lighter = [](const Link& a, const Link& b) { return a.weight < b.weight; };
    sum += 1.0 / std::min_element(links.begin(), links.end(), is_lighter)->weight;
    ++count;
  }
  return count > 0 ? static_cast<double>(count) / sum : 0.0;
}

template <QueueOrder order>
void search(const Graph& graph, BucketQueue<order> queue, std::span<const std::uint32_t> sources,
            const std::stop_token& stop, ShortestPaths& paths) {
  std::vector<typename BucketQueue<order>::Entry> offers(most_links(graph));
  for (const std::uint32_t source : sources) queue.push(0.0, source);
  while (!stop.stop_requested()) {
    const auto next = queue.pop(paths.cost);
    if (!next) break;
    const auto [cost_here, node] = *next;
    prefetch_links(graph, queue.soon(kSoon), queue.soon(2 * kSoon));
    // Which offers are taken cannot be foreseen: they are picked first, without a branch.
    std::size_t count = 0;
    for (const Link& link : graph.links_of(node)) {
      offers[count] = {cost_here + link.weight, link.node};
      count += offers[count].cost < paths.cost[link.node] ? 1 : 0;
    }
    for (auto [cost, other] : std::span(offers).first(count)) {
      // A weight too small to count still counts, so that parents come before their children.
      if (cost == cost_here) cost = std::nextafter(cost, kUnreached);
      if (cost >= paths.cost[other]) continue;
      paths.cost[other] = cost;
      paths.parent[other] = node;
      queue.push(cost, other);
    }
  }
}

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
  const double width = std::max(kBucketWidth * mean, heaviest / kBucketsMax);
  if (width <= kRoughUpTo * light_weight(graph)) {
    search(graph, BucketQueue<QueueOrder::rough>(width, heaviest), sources, stop, paths);
  } else {
    search(graph, BucketQueue<QueueOrder::exact>(width, heaviest), sources, stop, paths);
  }
  return paths;
}

}  // namespace ramify::pathplan
