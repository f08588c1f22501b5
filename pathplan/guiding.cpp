#include "pathplan/guiding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/rng.h"
#include "common/skeleton/skeleton.h"
#include "pathplan/bucket_queue.h"

namespace ramify::pathplan {
namespace {

// Of the bounds on what edges cost, for rounding.
constexpr double kCostSlack = 1e-6;

}  // namespace

GuidedSearch::GuidedSearch(const Graph& graph, const Level& level, double spacing, const Vec3& axis,
                           std::uint64_t seed)
    : graph_(graph),
      guiding_(level.guiding),
      is_periodic_(level.weights == WeightKind::periodic),
      spacing_(spacing),
      axis_(axis),
      seed_(seed),
      guides_(graph.nodes.size()) {
  double sum = 0.0;
  double least = kUnreached;
  double most = 0.0;
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto [a, b] = graph.edges[i];
    const double length = glm::distance(graph.nodes[a], graph.nodes[b]);
    sum += length;
    least = std::min(least, graph.weights[i] * length);
    most = std::max(most, graph.weights[i] * length);
  }
  if (!graph.edges.empty()) edge_length_ = sum / static_cast<double>(graph.edges.size());
  cheapest_ = least * guiding_.epsilon * (1.0 - kCostSlack);
  heaviest_ = most * (2.0 + guiding_.epsilon) * (1.0 + kCostSlack);
  for (const Vec3& node : graph.nodes) farthest_ = std::max(farthest_, glm::distance(node, graph.nodes[0]));
  guides_[0].vector = axis;
}

ShortestPaths GuidedSearch::paths_from(std::span<const std::uint32_t> sources, std::stop_token stop) {
  if (graph_.weights.empty()) return unsearched_paths(graph_.nodes.size(), sources);
  // In buckets narrower than the cheapest edge no node can better another: their order does not matter.
  if (heaviest_ / cheapest_ <= kBucketsMax) {
    return search(BucketQueue<QueueOrder::rough>(cheapest_, heaviest_), sources, stop);
  }
  return search(BucketQueue<QueueOrder::exact>(heaviest_ / kBucketsMax, heaviest_), sources, stop);
}

template <class Queue>
ShortestPaths GuidedSearch::search(Queue queue, std::span<const std::uint32_t> sources,
                                   const std::stop_token& stop) {
  ShortestPaths paths = unsearched_paths(graph_.nodes.size(), sources);
  for (const std::uint32_t source : sources) queue.push(0.0, source);
  while (!queue.is_empty() && !stop.stop_requested()) {
    const auto [cost_here, node] = queue.pop();
    if (cost_here > paths.cost[node]) continue;  // a better way was found since
    if (paths.parent[node] != kNoParent) guides_[node] = guide_after(paths.parent[node], node);
    for (const Link& link : graph_.links_of(node)) {
      double& cost_there = paths.cost[link.node];
      if (cost_there <= cost_here) continue;  // settled
      const double offer = cost_here + cost(node, link.node, link.weight);
      std::uint32_t& parent = paths.parent[link.node];
      if (offer < cost_there) {
        cost_there = offer;
        parent = node;
        queue.push(offer, link.node);
      } else if (offer == cost_there && std::pair(cost_here, node) < std::pair(paths.cost[parent], parent)) {
        parent = node;
      }
    }
  }
  return paths;
}

Guide GuidedSearch::guide_after(std::uint32_t parent, std::uint32_t node) const {
  const double way = glm::distance(graph_.nodes[parent], graph_.nodes[node]);
  return is_periodic_ ? turned_by_periods(guides_[parent], node, way)
                      : turned_outwards(guides_[parent], node, way);
}

/// Of a schedule over the distance from the root, 0 there to 1 at the farthest node.
double GuidedSearch::value_at(const Schedule& schedule, std::uint32_t node) const {
  if (schedule.is_constant() || farthest_ == 0.0) return schedule.at(0.0);
  return schedule.at(glm::distance(graph_.nodes[node], graph_.nodes[0]) / farthest_);
}

/// Away from the trunk, in the plane of trunk and node: outwards at first, then on downwards.
Guide GuidedSearch::turned_outwards(const Guide& before, std::uint32_t node, double way) const {
  const Vec3 from_root = graph_.nodes[node] - graph_.nodes[0];
  const Vec3 aside = from_root - axis_ * glm::dot(from_root, axis_);
  const double from_trunk = glm::length(aside);
  if (from_trunk < spacing_) return before;  // which way is out is not clear yet
  const double most = radians(guiding_.max_turn_deg);
  const double step = radians(value_at(guiding_.alpha_deg, node)) * way / spacing_;
  const double turned = std::clamp(before.turned + step, -most, most);
  const Vec3 hinge = glm::cross(axis_, aside / from_trunk);
  return {.vector = glm::normalize(rotated(before.vector, hinge, turned - before.turned)), .turned = turned};
}

/// About a random axis across the vector, each time that the way since the last turn has got long enough.
Guide GuidedSearch::turned_by_periods(const Guide& before, std::uint32_t node, double way) const {
  const double walked = before.walked + way;
  if (walked < value_at(guiding_.d, node) * edge_length_) {
    return {.vector = before.vector, .walked = walked};
  }
  Rng rng = Rng::stream(seed_, Stream::turn, node);
  const Vec3 hinge = perpendicular_at(before.vector, rng.uniform(0.0, 2.0 * std::numbers::pi));
  return {.vector = glm::normalize(rotated(before.vector, hinge, periodic_angle(node, rng)))};
}

/// Radians; drawn where there are chances.
double GuidedSearch::periodic_angle(std::uint32_t node, Rng& rng) const {
  if (guiding_.chances.empty()) return radians(value_at(guiding_.alpha_deg, node));
  double sum = 0.0;
  for (const TurnChance& chance : guiding_.chances) sum += chance.probability;
  double drawn = rng.uniform(0.0, sum);
  for (const TurnChance& chance : guiding_.chances) {
    if (drawn < chance.probability) return radians(chance.alpha_deg);
    drawn -= chance.probability;
  }
  return radians(guiding_.chances.back().alpha_deg);
}

}  // namespace ramify::pathplan
