#include "pathplan/branching.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

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

/// The root and the manual endpoints that can be nodes. For those outside the volume the nearest node stands.
std::vector<Vec3> seeds_of(const Level& level, const Vec3& root, const Solid& solid) {
  std::vector<Vec3> seeds = {root};
  if (level.endpoints != EndpointKind::manual) return seeds;
  for (const ManualPoint& point : level.points) {
    if (solid.contains(point.position)) seeds.push_back(point.position);
  }
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
    make_paths();
    if (!finish("paths")) return {};
    Branching branching = union_of_paths();
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
    std::vector<Vec3> seeds = pattern_.seeds;
    const auto is_obstructed = [&](const Vec3& seed) { return !domain_.contains(seed); };
    seeds.erase(std::remove_if(seeds.begin() + 1, seeds.end(), is_obstructed), seeds.end());
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
      assign_lengths(graph_);
    }
    if (domain_.surroundings.has_costs()) apply_cost_factors(graph_, domain_);
    link_nodes(graph_);
  }

  void make_paths() {
    if (pattern_.row.weights != WeightKind::random) {
      guided_.emplace(graph_, pattern_.row, spacing_, site_.axis, site_.seed,
                      domain_.surroundings.has_costs());
    }
    paths_.emplace(graph_.nodes.size());
    plan_first_paths();
    for (std::size_t i = 0; i < pattern_.row.stages.size() && !hooks_.stop.stop_requested(); ++i) {
      const std::vector<std::uint32_t> endpoints = choose_nearby_endpoints(
          graph_, *paths_, pattern_.row.stages[i], i + 1, site_.must_be_complete, site_.seed);
      add_paths(search(), endpoints);
    }
  }

  void plan_first_paths() {
    const ShortestPaths found = search();
    if (hooks_.stop.stop_requested()) return;
    is_connected_ =
        std::none_of(found.cost.begin(), found.cost.end(), [](double c) { return c == kUnreached; });
    std::vector<std::uint32_t> endpoints = first_endpoints(found);
    unreachable_ = std::erase_if(endpoints, [&](std::uint32_t node) { return !found.is_reached(node); });
    add_paths(found, endpoints);
  }

  /// From the paths found so far; at first from the root alone.
  ShortestPaths search() {
    const std::vector<std::uint32_t>& sources = paths_->nodes();
    return guided_ ? guided_->paths_from(sources, hooks_.stop) : shortest_paths(graph_, sources, hooks_.stop);
  }

  void add_paths(const ShortestPaths& found, const std::vector<std::uint32_t>& endpoints) {
    if (hooks_.stop.stop_requested()) return;  // what was found may be unfinished
    paths_->add(found, endpoints);
    tips_.insert(tips_.end(), endpoints.begin(), endpoints.end());
  }

  Branching union_of_paths() const {
    Branching branching{.position = {},
                        .parent = paths_->parents(),
                        .tips = {},
                        .counts = {.graphs = 1,
                                   .nodes = graph_.nodes.size(),
                                   .edges = graph_.edges.size(),
                                   .endpoints = tips_.size() + unreachable_,
                                   .unreachable = unreachable_}};
    for (const std::uint32_t node : paths_->nodes()) {
      branching.position.push_back(domain_.frame.to_world(graph_.nodes[node]));
    }
    for (const std::uint32_t node : tips_) branching.tips.push_back(paths_->place(node));
    return branching;
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
    planned.edge_length = guided_ ? guided_->edge_length() : mean_edge_length(graph_);
    planned.components = is_connected_ ? 1 : component_count(graph_);
    if (guided_) planned.guides = guided_->guides();
    if (guided_ && hooks_.wants_guided_costs) {
      for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
        const auto [a, b] = graph_.edges[i];
        planned.guided_costs.push_back(
            {guided_->cost(a, b, graph_.weights[i]), guided_->cost(b, a, graph_.weights[i])});
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
  std::optional<GuidedSearch> guided_;     // of guiding vectors
  std::optional<PathUnion> paths_;
  std::vector<std::uint32_t> tips_;  // endpoints in the union
  std::size_t unreachable_ = 0;      // endpoints that are not
};

}  // namespace

Pattern::Pattern(const Level& level, const Volume& volume, const Vec3& root, double obstructed)
    : row(level),
      solid(volume),
      cubic_metres(free_volume(volume, obstructed)),
      seeds(seeds_of(level, root, solid)),
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
