#include "pathplan/branching.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/errors.h"
#include "pathplan/edge_rules.h"
#include "pathplan/endpoints.h"
#include "pathplan/lattice.h"
#include "pathplan/path_union.h"
#include "pathplan/shortest_paths.h"
#include "pathplan/threshold_graph.h"
#include "pathplan/weights.h"
#include "pathplan/yao_graph.h"

namespace ramify::pathplan {
namespace {

// Volumes are counted to about 0.3 %: how much is left of one that is nearly full is not known.
constexpr double kLeastFree = 0.01;

// A lattice's edges are as long as its spacing but for rounding, which must not make them too long.
constexpr double kLengthSlack = 1e-9;

/// Cubic metres that nodes may fill.
double free_volume(const Volume& volume, double obstructed) {
  const double all = volume_of(volume);
  if (all - obstructed >= kLeastFree * all) return all - obstructed;
  throw RunError(fmt::format("obstacles: less than {:g} % of the volume is free (smaller ones, or beside it)",
                             100.0 * kLeastFree));
}

std::vector<Vec3> seeds_of(const Level& level, const Vec3& root) {
  std::vector<Vec3> seeds = {root};
  if (level.endpoints != EndpointKind::manual) return seeds;
  for (const ManualPoint& point : level.points) seeds.push_back(point.position);
  return seeds;
}

Scatter scatter_of(const Level& level) {
  return {.nodes = level.nodes, .spacing = level.spacing};
}

/// The making of one graph and its branches, step by step.
class Planner {
 public:
  Planner(const Pattern& pattern, const Site& site, const Surroundings& surroundings,
          const BranchingHooks& hooks)
      : pattern_(pattern), site_(site), hooks_(hooks), domain_{pattern.solid, surroundings, site.frame} {}

  Branching run() {
    make_nodes();
    if (!finish("nodes")) return {};
    make_edges();
    if (!finish("graph")) return {};
    Branching branching = make_paths();
    if (!finish("paths")) return {};
    if (hooks_.graph) hand_over_graph();
    return branching;
  }

 private:
  bool finish(std::string_view stage) const {
    if (hooks_.stop.stop_requested()) return false;
    if (hooks_.on_stage) hooks_.on_stage(stage);
    return true;
  }

  void make_nodes() {
    // Manual endpoints outside the volume are no nodes: the nearest one stands for each.
    std::vector<Vec3> seeds = {pattern_.seeds.front()};
    for (std::size_t i = 1; i < pattern_.seeds.size(); ++i) {
      if (domain_.contains(pattern_.seeds[i])) seeds.push_back(pattern_.seeds[i]);
    }
    Nodes nodes = pattern_.row.layout == Layout::lattice
                      ? lattice_nodes(domain_, seeds.front(), scatter_of(pattern_.row), pattern_.cubic_metres)
                      : pattern_.poisson_disc.scatter(domain_, seeds, site_.must_be_complete, site_.seed,
                                                      hooks_.stop, hooks_.on_nodes);
    graph_.nodes = std::move(nodes.position);
    spacing_ = nodes.spacing;
    if (!site_.crown) return;
    for (const Vec3& node : graph_.nodes) subvolumes_.push_back(site_.crown->subvolume_of(node));
  }

  void make_edges() {
    const Level& row = pattern_.row;
    const double max_length = row.max_edge * spacing_ * (1.0 + kLengthSlack);
    const EdgeRules rules(domain_, graph_.nodes, max_length, subvolumes_);
    graph_.edges = row.edges == EdgeKind::yao
                       ? yao_edges(graph_.nodes, rules, row.sectors, spacing_, hooks_.stop)
                       : threshold_edges(graph_.nodes, rules, hooks_.stop);
    if (row.weights == WeightKind::random) {
      assign_random_weights(graph_, {.exponent = row.weight_exponent,
                                     .low = row.weight_low,
                                     .high = row.weight_high,
                                     .seed = site_.seed});
    } else {
      graph_.weights.assign(graph_.edges.size(), 1.0f);
    }
    if (domain_.surroundings.has_costs()) apply_cost_factors(graph_, domain_);
    link_nodes(graph_);
  }

  Branching make_paths() {
    if (pattern_.row.weights != WeightKind::random) {
      search_.emplace(graph_, pattern_.row, spacing_, site_.axis, site_.seed);
    }
    PathUnion paths(graph_.nodes.size());
    ShortestPaths found = search_from(paths.nodes());
    if (hooks_.stop.stop_requested()) return {};
    is_connected_ =
        std::none_of(found.cost.begin(), found.cost.end(), [](double c) { return c == kUnreached; });
    Branching branching;
    std::vector<std::uint32_t> endpoints = first_endpoints(found);
    branching.counts.endpoints += endpoints.size();
    std::erase_if(endpoints, [&](std::uint32_t node) { return !found.is_reached(node); });
    branching.counts.unreachable = branching.counts.endpoints - endpoints.size();
    paths.add(found, endpoints);
    std::vector<std::uint32_t> tips = endpoints;

    const std::vector<Stage>& stages = pattern_.row.stages;
    for (std::size_t i = 0; i < stages.size() && !hooks_.stop.stop_requested(); ++i) {
      endpoints =
          choose_nearby_endpoints(graph_, paths, stages[i], i + 1, site_.must_be_complete, site_.seed);
      found = search_from(paths.nodes());
      if (hooks_.stop.stop_requested()) return {};
      paths.add(found, endpoints);
      branching.counts.endpoints += endpoints.size();
      tips.insert(tips.end(), endpoints.begin(), endpoints.end());
    }
    branching.counts.graphs = 1;
    branching.counts.nodes = graph_.nodes.size();
    branching.counts.edges = graph_.edges.size();

    for (const std::uint32_t node : paths.nodes()) {
      branching.position.push_back(domain_.frame.to_world(graph_.nodes[node]));
    }
    branching.parent = paths.parents();
    for (const std::uint32_t node : tips) branching.tips.push_back(paths.place(node));
    return branching;
  }

  ShortestPaths search_from(const std::vector<std::uint32_t>& sources) {
    return search_ ? search_->paths_from(sources, hooks_.stop) : shortest_paths(graph_, sources, hooks_.stop);
  }

  std::vector<std::uint32_t> first_endpoints(const ShortestPaths& found) const {
    Candidates candidates{.nodes = graph_.nodes, .region = site_.region, .subvolumes = subvolumes_};
    // What an obstacle cuts off is no place for a branch; the endpoints of a refined crown are in its
    // spheres.
    const bool has_obstacles = domain_.surroundings.has_obstacles();
    if (has_obstacles || site_.crown) {
      candidates.is_fit = [&, has_obstacles](std::uint32_t node) {
        return (!has_obstacles || found.is_reached(node)) &&
               (!site_.crown || subvolumes_[node] == 0 ||
                site_.crown->is_in_sphere(graph_.nodes[node], subvolumes_[node]));
      };
    }
    const Level& row = pattern_.row;
    return choose_endpoints(candidates, {.kind = row.endpoints,
                                         .b = site_.b,
                                         .shell_thickness = row.shell_thickness,
                                         .points = row.points,
                                         .must_be_all = site_.must_be_complete,
                                         .seed = site_.seed});
  }

  void hand_over_graph() {
    PlannedGraph& planned = *hooks_.graph;
    planned.edge_length = mean_edge_length(graph_);
    planned.components = is_connected_ ? 1 : component_count(graph_);
    if (search_) {
      planned.guides = search_->guides();
      for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
        const auto [a, b] = graph_.edges[i];
        planned.guided_costs.push_back(
            {search_->cost(a, b, graph_.weights[i]), search_->cost(b, a, graph_.weights[i])});
      }
    }
    planned.subvolumes = std::move(subvolumes_);
    planned.graph = std::move(graph_);
  }

  const Pattern& pattern_;
  const Site& site_;
  const BranchingHooks& hooks_;
  Domain domain_;
  Graph graph_;
  double spacing_ = 0.0;  // metres
  bool is_connected_ = true;
  std::vector<std::uint32_t> subvolumes_;  // of each node, in a refined crown
  std::optional<GuidedSearch> search_;     // of guiding vectors
};

}  // namespace

Pattern::Pattern(const Level& level, const Volume& volume, const Vec3& root, double obstructed)
    : row(level),
      solid(volume),
      cubic_metres(free_volume(volume, obstructed)),
      seeds(seeds_of(level, root)),
      poisson_disc(solid, scatter_of(level), cubic_metres, seeds) {}

void GraphCounts::add(const GraphCounts& other) {
  graphs += other.graphs;
  nodes += other.nodes;
  edges += other.edges;
  endpoints += other.endpoints;
  unreachable += other.unreachable;
}

Branching plan_branching(const Pattern& pattern, const Site& site, const Surroundings& surroundings,
                         const BranchingHooks& hooks) {
  return Planner(pattern, site, surroundings, hooks).run();
}

}  // namespace ramify::pathplan
