#include "pathplan/shortest_paths.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "common/skeleton/skeleton.h"

namespace ramify::pathplan {
namespace {

// In mean weights, which are about 0.8 of the spacing for factors from 0.1 to 1. Narrower buckets are mostly
// empty; in wider ones more nodes are looked at again.
constexpr double kBucketWidth = 0.12;

// Weights that vary very much, as with a large exponent, must not need as many buckets.
constexpr double kBucketsMax = 4096.0;

/// Nodes whose cost got less, in a ring of buckets that is as long as the heaviest edge. Within a bucket
/// nodes come in the order they were put in, so a node may be looked at again; no cost is final until its
/// bucket is empty.
class BucketQueue {
 public:
  struct Entry {
    double cost;
    std::uint32_t node;
  };

  explicit BucketQueue(std::span<const float> weights) {
    double sum = 0.0;
    double heaviest = 0.0;
    for (const float weight : weights) {
      sum += weight;
      heaviest = std::max<double>(heaviest, weight);
    }
    if (weights.empty()) return;
    const double mean = sum / static_cast<double>(weights.size());
    const double width = std::max(kBucketWidth * mean, heaviest / kBucketsMax);
    buckets_per_cost_ = 1.0 / width;
    ring_.resize(std::bit_ceil(static_cast<std::size_t>(heaviest * buckets_per_cost_) + 3));
  }

  void push(double cost, std::uint32_t node) {
    ring_[static_cast<std::size_t>(cost * buckets_per_cost_) & (ring_.size() - 1)].push_back({cost, node});
    ++size_;
  }

  /// Takes the next bucket's entries one by one; visit() may push.
  template <class Visit>
  void visit_next_bucket(const Visit& visit) {
    std::vector<Entry>& bucket = ring_[next_++ & (ring_.size() - 1)];
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      const Entry entry = bucket[i];
      visit(entry);
    }
    size_ -= bucket.size();
    bucket.clear();
  }

  bool is_empty() const { return size_ == 0; }

 private:
  double buckets_per_cost_ = 1.0;
  std::vector<std::vector<Entry>> ring_ = std::vector<std::vector<Entry>>(1);
  std::size_t next_ = 0;  // bucket
  std::size_t size_ = 0;  // entries
};

}  // namespace

ShortestPaths shortest_paths(const Graph& graph, std::uint32_t source, std::stop_token stop) {
  ShortestPaths paths;
  paths.cost.assign(graph.nodes.size(), kUnreached);
  paths.parent.assign(graph.nodes.size(), kNoParent);
  paths.cost[source] = 0.0;

  BucketQueue queue(graph.weights);
  queue.push(0.0, source);
  while (!queue.is_empty() && !stop.stop_requested()) {
    queue.visit_next_bucket([&](const BucketQueue::Entry& entry) {
      if (entry.cost > paths.cost[entry.node]) return;  // a better way was found since
      for (const Link& link : graph.links_of(entry.node)) {
        double cost = entry.cost + link.weight;
        // A weight too small to count still counts, so that parents come before their children.
        if (cost == entry.cost) cost = std::nextafter(cost, kUnreached);
        if (cost >= paths.cost[link.node]) continue;
        paths.cost[link.node] = cost;
        paths.parent[link.node] = entry.node;
        queue.push(cost, link.node);
      }
    });
  }
  return paths;
}

}  // namespace ramify::pathplan
