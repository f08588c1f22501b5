// Graphs that tests plan in, what may be joined in them by every pair, and runs of the engine.
#pragma once

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "common/base/rng.h"
#include "pathplan/engine.h"
#include "pathplan/poisson_disc.h"
#include "pathplan/weights.h"
#include "pathplan/yao_graph.h"
#include "tests/pathplan/volumes.h"

namespace ramify::test {

inline const std::vector<std::uint32_t> kRoot = {0};

inline pathplan::Graph graph_of(std::vector<Vec3> nodes, std::vector<pathplan::Edge> edges,
                                std::vector<float> weights) {
  pathplan::Graph graph;
  graph.nodes = std::move(nodes);
  graph.edges = std::move(edges);
  graph.weights = std::move(weights);
  link_nodes(graph);
  return graph;
}

/// The Yao graph of Poisson-disc nodes with random weights.
inline pathplan::Graph graph_in(const Place& place, int count, const pathplan::RandomWeights& weights,
                                int sectors = 8) {
  const pathplan::Nodes nodes =
      pathplan::scatter_nodes(place.volume, place.root, {.nodes = count}, weights.seed);
  const OpenDomain open(place.volume);
  const pathplan::EdgeRules rules(open.domain, nodes.position, 3.0 * nodes.spacing);
  pathplan::Graph graph;
  graph.nodes = nodes.position;
  graph.edges = yao_edges(nodes.position, rules, sectors, nodes.spacing);
  assign_random_weights(graph, weights);
  link_nodes(graph);
  return graph;
}

/// Edges whatever their order and direction.
inline std::set<pathplan::Edge> as_set(const std::vector<pathplan::Edge>& edges) {
  std::set<pathplan::Edge> set;
  for (const auto& [a, b] : edges) set.insert({std::min(a, b), std::max(a, b)});
  return set;
}

/// A ball and a thin wall that stand in the way, with tests of their own of what meets them.
struct BallAndWall {
  Vec3 center{0.0};
  double radius = 1.0;
  Box wall{Vec3(0.0), Vec3(1.0)};

  std::vector<pathplan::Obstacle> obstacles() const {
    return {{{.shape = Shape::sphere, .center = center, .radius = radius}},
            {{.shape = Shape::box, .center = wall.center(), .size = wall.size()}}};
  }

  bool meets(const Vec3& from, const Vec3& to) const {
    return distance_to_segment(center, from, to) <= radius || wall_meets(from, to);
  }

  static double distance_to_segment(const Vec3& point, const Vec3& from, const Vec3& to) {
    const Vec3 along = to - from;
    const double square = glm::dot(along, along);
    const double share = square > 0.0 ? glm::clamp(glm::dot(point - from, along) / square, 0.0, 1.0) : 0.0;
    return glm::distance(point, from + share * along);
  }

 private:
  /// What the slabs between opposite faces leave of the segment.
  bool wall_meets(const Vec3& from, const Vec3& to) const {
    double begin = 0.0;
    double end = 1.0;
    for (int i = 0; i < 3; ++i) {
      const double way = to[i] - from[i];
      if (way == 0.0) {
        if (from[i] < wall.low[i] || from[i] > wall.high[i]) return false;
        continue;
      }
      const double low = (wall.low[i] - from[i]) / way;
      const double high = (wall.high[i] - from[i]) / way;
      begin = std::max(begin, std::min(low, high));
      end = std::min(end, std::max(low, high));
    }
    return begin <= end;
  }
};

/// Which nodes an edge may join, by the definition: asked of every pair.
struct PlainRules {
  const Solid& solid;
  double max_length;
  const BallAndWall* obstacles = nullptr;
  std::vector<std::uint32_t> subvolumes = {};

  bool allow(const std::vector<Vec3>& nodes, std::uint32_t u, std::uint32_t v) const {
    const Vec3 d = nodes[v] - nodes[u];
    if (glm::dot(d, d) > max_length * max_length) return false;
    for (const double share : {0.25, 0.5, 0.75}) {
      if (!solid.contains(nodes[u] + share * d)) return false;
    }
    if (obstacles && obstacles->meets(nodes[u], nodes[v])) return false;
    return subvolumes.empty() || subvolumes[u] == subvolumes[v] || subvolumes[u] == 0 || subvolumes[v] == 0;
  }
};

/// A number of 0 .. count - 1 for each node, drawn.
inline std::vector<std::uint32_t> drawn_subvolumes(std::size_t nodes, std::uint64_t count,
                                                   std::uint64_t seed) {
  Rng rng = Rng::stream(seed, Stream::surplus, 0);
  std::vector<std::uint32_t> subvolumes(nodes);
  for (std::uint32_t& subvolume : subvolumes) subvolume = static_cast<std::uint32_t>(rng.below(count));
  return subvolumes;
}

/// Makes the layers, too, that every config has.
inline RunResult run_with_layers(const pathplan::Parameters& parameters) {
  RunContext context;
  context.layers = {"graph", "endpoints", "guiding"};
  if (parameters.levels.front().weights == pathplan::WeightKind::random) context.layers.pop_back();
  return pathplan::Engine::run(parameters, context);
}

template <class T>
const T& layer(const RunResult& result, std::string_view name) {
  for (const Layer& candidate : result.layers) {
    if (candidate.name == name) return std::get<T>(candidate.data);
  }
  throw std::out_of_range(std::string(name));
}

/// A value of the report.
inline double reported(const RunResult& result, std::string_view group, std::string_view name) {
  for (const ReportGroup& candidate : result.report.groups) {
    if (candidate.name != group) continue;
    for (const auto& [key, value] : candidate.values) {
      if (key == name) return value;
    }
  }
  throw std::out_of_range(std::string(name));
}

inline bool is_same(const Skeleton& a, const Skeleton& b) {
  return a.position == b.position && a.parent == b.parent && a.diameter == b.diameter && a.axis == b.axis &&
         a.order == b.order && a.level == b.level && a.kind == b.kind;
}

/// Whether a point of a graph's own frame, so far along +Y and so far from that axis, is in a subgraph of
/// this shape and reach: XM12's shapes in closed form. A custom one is not known here.
inline bool is_in_subgraph(const pathplan::Level& row, double reach, double along, double across,
                           double tolerance) {
  const double half_width = reach * std::tan(radians(row.alpha_deg));
  switch (row.subgraph) {
    case pathplan::SubgraphShape::sphere_portion: {
      const double from_root = std::hypot(along, across);
      const double angle = std::atan2(across, along);
      return from_root <= reach + tolerance &&
             (from_root * std::max(0.0, angle - radians(row.alpha_deg)) <= tolerance);
    }
    case pathplan::SubgraphShape::cone:
      return along >= -tolerance && along <= reach + tolerance &&
             across <= half_width * (1.0 - along / reach) + tolerance;
    case pathplan::SubgraphShape::inverted_cone:
      return along <= reach + tolerance && across <= half_width * along / reach + tolerance;
    case pathplan::SubgraphShape::ellipsoid:
      return std::hypot((along - reach / 2.0) / (reach / 2.0), across / (half_width / 2.0)) <=
             1.0 + tolerance / std::min(reach / 2.0, half_width / 2.0);
    case pathplan::SubgraphShape::custom:
      break;
  }
  throw std::invalid_argument("a custom subgraph");
}

}  // namespace ramify::test
