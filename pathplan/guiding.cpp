#include "pathplan/guiding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/rng.h"
#include "common/skeleton/skeleton.h"
#include "pathplan/bucket_queue.h"

namespace ramify::pathplan {
namespace {

// Of the bounds on what edges cost: weights are rounded to single precision.
constexpr double kCostSlack = 1e-4;

}  // namespace

GuidedSearch::GuidedSearch(const Graph& graph, const Level& level, double spacing, const Vec3& axis,
                           std::uint64_t seed, bool has_cost_factors)
    : graph_(graph),
      guiding_(level.guiding),
      is_periodic_(level.weights == WeightKind::periodic),
      cost_{1.0 + level.guiding.epsilon, has_cost_factors},
      spacing_(spacing),
      axis_(axis),
      seed_(seed),
      edge_length_(mean_edge_length(graph)),
      guides_(graph.nodes.size()) {
  if (!graph.weights.empty()) {
    const auto [least, most] = std::minmax_element(graph.weights.begin(), graph.weights.end());
    cheapest_ = *least * guiding_.epsilon * (1.0 - kCostSlack);
    heaviest_ = *most * (2.0 + guiding_.epsilon) * (1.0 + kCostSlack);
  }
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
  const std::span<double> costs = paths.cost;
  const std::span<std::uint32_t> parents = paths.parent;
  const GuidedCost cost = cost_;  // here, or it would be read again for each edge
  std::vector<typename Queue::Entry> offers(most_links(graph_));
  for (const std::uint32_t source : sources) queue.push(0.0, source);
  while (!stop.stop_requested()) {
    const auto next = queue.pop(costs);
    if (!next) break;
    const auto [cost_here, node] = *next;
    prefetch_links(graph_, queue.soon(kSoon), queue.soon(2 * kSoon));
    if (parents[node] != kNoParent) set_guide(node, parents[node]);
    const Vec3& vector = guides_[node].vector;
    const Vec3 here = graph_.nodes[node];
    // Which offers are taken cannot be foreseen: they are picked first, without a branch.
    std::size_t count = 0;
    for (const Link& link : graph_.links_of(node)) {
      const double offer = cost_here + cost(vector, graph_.nodes[link.node] - here, link.weight);
      offers[count] = {offer, link.node};
      count += offer <= costs[link.node] ? 1 : 0;
    }
    for (const auto& [offer, other] : std::span(offers).first(count)) {
      std::uint32_t& parent = parents[other];
      if (offer < costs[other]) {
        costs[other] = offer;
        parent = node;
        queue.push(offer, other);
      } else if (offer == costs[other] && std::pair(cost_here, node) < std::pair(costs[parent], parent)) {
        parent = node;
      }
    }
  }
  return paths;
}

/// In place: a vector handed from function to function costs more than its use.
void GuidedSearch::set_guide(std::uint32_t node, std::uint32_t parent) {
  const double way = glm::distance(graph_.nodes[parent], graph_.nodes[node]);
  Guide& guide = guides_[node];
  guide = guides_[parent];
  is_periodic_ ? turn_by_periods(guide, node, way) : turn_outwards(guide, node, way);
}

/// Of a schedule over the distance from the root, 0 there to 1 at the farthest node.
double GuidedSearch::value_at(const Schedule& schedule, std::uint32_t node) const {
  if (schedule.is_constant() || farthest_ == 0.0) return schedule.at(0.0);
  return schedule.at(glm::distance(graph_.nodes[node], graph_.nodes[0]) / farthest_);
}

/// Away from the trunk, in the plane of trunk and node: outwards at first, then on downwards.
void GuidedSearch::turn_outwards(Guide& guide, std::uint32_t node, double way) const {
  const Vec3 from_root = graph_.nodes[node] - graph_.nodes[0];
  const Vec3 aside = from_root - axis_ * glm::dot(from_root, axis_);
  const double from_trunk = glm::length(aside);
  if (from_trunk < spacing_) return;  // which way is out is not clear yet
  const double most = radians(guiding_.max_turn_deg);
  const double step = radians(value_at(guiding_.alpha_deg, node)) * way / spacing_;
  const double turned = std::clamp(guide.progress + step, -most, most);
  if (turned == guide.progress) return;  // it has turned as far as it may
  const Vec3 hinge = glm::cross(axis_, aside) * (1.0 / from_trunk);
  guide.vector = rotated(guide.vector, hinge, turned - guide.progress);
  guide.progress = turned;
}

/// About a random axis across the vector, each time that the way since the last turn has got long enough.
void GuidedSearch::turn_by_periods(Guide& guide, std::uint32_t node, double way) const {
  guide.progress += way;
  if (guide.progress < value_at(guiding_.d, node) * edge_length_) return;
  Rng rng = Rng::stream(seed_, Stream::turn, node);
  const Vec3 hinge = perpendicular_at(guide.vector, rng.uniform(0.0, 2.0 * std::numbers::pi));
  guide.vector = rotated(guide.vector, hinge, periodic_angle(node, rng));
  guide.progress = 0.0;
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
