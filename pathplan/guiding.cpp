#include "pathplan/guiding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/rng.h"
#include "common/skeleton/skeleton.h"
#include "pathplan/bucket_queue.h"

namespace ramify::pathplan {
namespace {

// Costs vary from epsilon to 2 + epsilon in lengths; most edges that matter are in the lower part.
constexpr double kTypicalCost = 0.5;

}  // namespace

GuidedSearch::GuidedSearch(const Graph& graph, const Level& level, double spacing, const Vec3& axis,
                           std::uint64_t seed)
    : graph_(graph),
      guiding_(level.guiding),
      is_periodic_(level.weights == WeightKind::periodic),
      spacing_(spacing),
      axis_(axis),
      seed_(seed),
      edge_length_(mean_edge_length(graph)),
      heaviest_(0.0),
      farthest_(0.0),
      guides_(graph.nodes.size()) {
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto [a, b] = graph.edges[i];
    const double length = glm::distance(graph.nodes[a], graph.nodes[b]);
    heaviest_ = std::max(heaviest_, graph.weights[i] * length * (2.0 + guiding_.epsilon));
  }
  for (const Vec3& node : graph.nodes) farthest_ = std::max(farthest_, glm::distance(node, graph.nodes[0]));
  guides_[0].vector = axis;
}

double GuidedSearch::cost(std::uint32_t from, std::uint32_t to, double factor) const {
  const Vec3 way = graph_.nodes[to] - graph_.nodes[from];
  return factor *
         (std::sqrt(glm::dot(way, way)) * (1.0 + guiding_.epsilon) - glm::dot(guides_[from].vector, way));
}

ShortestPaths GuidedSearch::paths_from(std::span<const std::uint32_t> sources, std::stop_token stop) {
  ShortestPaths paths = unsearched_paths(graph_.nodes.size(), sources);
  std::vector<bool> is_settled(graph_.nodes.size(), false);
  std::vector<bool> is_source(graph_.nodes.size(), false);
  BucketQueue<QueueOrder::exact> queue(kTypicalCost * edge_length_, heaviest_);
  for (const std::uint32_t source : sources) {
    is_source[source] = true;
    queue.push(0.0, source);
  }

  while (!queue.is_empty() && !stop.stop_requested()) {
    const auto [cost_here, node] = queue.pop();
    if (is_settled[node]) continue;
    is_settled[node] = true;
    if (!is_source[node]) guides_[node] = guide_after(paths.parent[node], node);
    for (const Link& link : graph_.links_of(node)) {
      if (is_settled[link.node]) continue;
      const double there = cost_here + cost(node, link.node, link.weight);
      if (there >= paths.cost[link.node]) continue;
      paths.cost[link.node] = there;
      paths.parent[link.node] = node;
      queue.push(there, link.node);
    }
  }
  return paths;
}

Guide GuidedSearch::guide_after(std::uint32_t parent, std::uint32_t node) const {
  const double way = glm::distance(graph_.nodes[parent], graph_.nodes[node]);
  return is_periodic_ ? turned_by_periods(guides_[parent], node, way)
                      : turned_outwards(guides_[parent], node, way);
}

/// How far a node is from the root, 0 to 1 at the farthest.
double GuidedSearch::share_of_way(std::uint32_t node) const {
  return farthest_ > 0.0 ? glm::distance(graph_.nodes[node], graph_.nodes[0]) / farthest_ : 0.0;
}

/// Away from the trunk, in the plane of trunk and node: outwards at first, then on downwards.
Guide GuidedSearch::turned_outwards(const Guide& before, std::uint32_t node, double way) const {
  const Vec3 from_root = graph_.nodes[node] - graph_.nodes[0];
  const Vec3 aside = from_root - axis_ * glm::dot(from_root, axis_);
  const double from_trunk = glm::length(aside);
  if (from_trunk < spacing_) return before;  // which way is out is not clear yet
  const double most = radians(guiding_.max_turn_deg);
  const double step = radians(guiding_.alpha_deg.at(share_of_way(node))) * way / spacing_;
  const double turned = std::clamp(before.turned + step, -most, most);
  const Vec3 hinge = glm::cross(axis_, aside / from_trunk);
  return {.vector = glm::normalize(rotated(before.vector, hinge, turned - before.turned)), .turned = turned};
}

/// About a random axis across the vector, each time that the way since the last turn has got long enough.
Guide GuidedSearch::turned_by_periods(const Guide& before, std::uint32_t node, double way) const {
  const double walked = before.walked + way;
  const double distance = share_of_way(node);
  if (walked < guiding_.d.at(distance) * edge_length_) return {.vector = before.vector, .walked = walked};
  Rng rng = Rng::stream(seed_, Stream::turn, node);
  const Vec3 hinge = perpendicular_at(before.vector, rng.uniform(0.0, 2.0 * std::numbers::pi));
  return {.vector = glm::normalize(rotated(before.vector, hinge, periodic_angle(distance, rng)))};
}

/// Radians; drawn where there are chances.
double GuidedSearch::periodic_angle(double distance, Rng& rng) const {
  if (guiding_.chances.empty()) return radians(guiding_.alpha_deg.at(distance));
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
