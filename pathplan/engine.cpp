#include "pathplan/engine.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/base/errors.h"
#include "common/base/rng.h"
#include "common/base/stopwatch.h"
#include "common/skeleton/passes.h"
#include "pathplan/levels.h"
#include "pathplan/parameter_check.h"
#include "pathplan/widths.h"

namespace ramify::pathplan {
namespace {

LevelPlan stem_plan(const Parameters& parameters) {
  return {.levels = std::span(parameters.levels).first(planned_levels(parameters)),
          .refine = parameters.refine,
          .lifespan = parameters.lifespan,
          .light = parameters.light,
          .seed = parameters.seed};
}

LevelPlan root_plan(const Parameters& parameters) {
  return {.levels = parameters.roots,
          .axis = -kUp,
          .seed = Rng::stream(parameters.seed, Stream::root_graphs, 0).next()};
}

/// Throws, or warns, if endpoints are not reached.
void tell_unreachable(const PlannedTree& tree, Unreachable unreachable, Report& report) {
  if (tree.counts.unreachable == 0) return;
  const std::string problem = fmt::format("{} of {} endpoints cannot be reached from the root",
                                          tree.counts.unreachable, tree.counts.endpoints);
  if (unreachable == Unreachable::error) {
    throw RunError(
        problem +
        " (raise nodes or max_edge, make the volume's thin places and overlaps wider, or leave them "
        "out: pathplan.unreachable = \"warn\")");
  }
  report.warnings.push_back(problem + ": they are left out");
}

ReportGroup first_graph_report(const PlannedGraph& first) {
  const auto nodes = static_cast<double>(first.graph.nodes.size());
  const auto edges = static_cast<double>(first.graph.edges.size());
  return {"graph",
          {{"nodes", nodes},
           {"edges", edges},
           {"edges_per_node", edges / nodes},
           {"components", static_cast<double>(first.components)},
           {"unreachable", static_cast<double>(first.unreachable)}}};
}

ReportGroup all_graphs_report(const GraphCounts& counts) {
  return {"all_graphs",
          {{"graphs", static_cast<double>(counts.graphs)},
           {"nodes", static_cast<double>(counts.nodes)},
           {"edges", static_cast<double>(counts.edges)},
           {"endpoints", static_cast<double>(counts.endpoints)}}};
}

Layer graph_layer(const PlannedGraph& planned) {
  const Graph& graph = planned.graph;
  LineLayer layer{.points = graph.nodes,
                  .point_values = std::vector<double>(graph.nodes.size(), 0.0),
                  .lines = graph.edges,
                  .values = {graph.weights.begin(), graph.weights.end()}};
  std::copy(planned.subvolumes.begin(), planned.subvolumes.end(), layer.point_values.begin());
  if (planned.guides.empty()) return {"graph", std::move(layer)};
  layer.lines.clear();
  layer.values.clear();
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto [a, b] = graph.edges[i];
    layer.lines.insert(layer.lines.end(), {{a, b}, {b, a}});
    layer.values.insert(layer.values.end(), planned.guided_costs[i].begin(), planned.guided_costs[i].end());
  }
  return {"graph", std::move(layer)};
}

Layer endpoint_layer(const PlannedTree& tree) {
  PointLayer layer;
  for (std::size_t level = 0; level < tree.tips.size(); ++level) {
    for (const Tip& tip : tree.tips[level]) {
      layer.points.push_back(tree.skeleton.position[tip.node]);
      layer.values.push_back(static_cast<double>(level + 1));
    }
  }
  return {"endpoints", std::move(layer)};
}

Layer guiding_layer(const PlannedGraph& planned) {
  VectorLayer layer{.points = planned.graph.nodes, .vectors = {}};
  for (const Guide& guide : planned.guides) layer.vectors.push_back(guide.vector);
  return {"guiding", std::move(layer)};
}

void make_layers(const PlannedTree& tree, const RunContext& context, std::vector<Layer>& layers) {
  if (context.wants("graph")) layers.push_back(graph_layer(tree.first));
  if (context.wants("endpoints")) layers.push_back(endpoint_layer(tree));
  if (context.wants("guiding")) layers.push_back(guiding_layer(tree.first));
}

/// Widths, axes and orders for what was planned.
Skeleton finished(PlannedTree& planned, std::span<const Level> levels, Kind kind,
                  const Parameters& parameters) {
  Skeleton tree = std::move(planned.skeleton);
  tree.kind.assign(tree.node_count(), kind);
  if (parameters.widths == WidthModel::pipe) {
    assign_piped_widths(tree, parameters.pipe_exponent, parameters.trunk_diameter, parameters.tip_diameter);
  } else {
    std::vector<TaperedTips> tapered;
    for (std::size_t level = 0; level < planned.tips.size(); ++level) {
      TaperedTips& tips = tapered.emplace_back();
      tips.zeta = levels[level].zeta;
      for (const Tip& tip : planned.tips[level]) tips.nodes.push_back(tip.node);
    }
    assign_tapered_widths(tree, tapered, planned.first.edge_length, parameters.trunk_diameter,
                          parameters.tip_diameter);
  }
  assign_axes(tree);
  return tree;
}

}  // namespace

std::vector<std::string> Engine::layers(const Parameters& parameters) {
  std::vector<std::string> names = {"graph", "endpoints"};
  if (parameters.levels.front().weights != WeightKind::random) names.emplace_back("guiding");
  return names;
}

UsedVolumes Engine::volumes(const Parameters& parameters) {
  UsedVolumes used;
  for (const Obstacle& obstacle : parameters.obstacles) used.obstacles.push_back(&obstacle.volume);
  for (const std::vector<Level>* levels : {&parameters.levels, &parameters.roots}) {
    if (levels->empty()) continue;
    const Level& first = levels->front();
    used.others.push_back(&first.volume);
    const bool has_region = first.endpoints == EndpointKind::region || first.endpoints == EndpointKind::shell;
    const bool is_own = first.region.shape != Shape::union_of || !first.region.parts.empty();
    if (has_region && is_own) used.others.push_back(&first.region);
  }
  for (const CostVolume& cost : parameters.costs) used.others.push_back(&cost.volume);
  return used;
}

std::vector<std::string> Engine::check(const Parameters& parameters) {
  return check_parameters(parameters);
}

RunResult Engine::run(const Parameters& parameters, const RunContext& context) {
  const Surroundings surroundings(parameters);
  RunResult result;
  Stopwatch watch;
  const LevelPlan plan = stem_plan(parameters);
  PlannedTree planned = plan_levels(plan, parameters.root, surroundings, context, watch);
  result.is_complete = planned.is_complete;
  GraphCounts counts = planned.counts;
  if (!planned.tips.empty()) {
    tell_unreachable(planned, parameters.unreachable, result.report);
    result.report.groups.push_back(first_graph_report(planned.first));
    make_layers(planned, context, result.layers);
  }

  std::vector<Skeleton> parts;
  if (result.is_complete && !parameters.roots.empty()) {
    Stopwatch unbooked;  // their stages are one of ours
    const LevelPlan below = root_plan(parameters);
    PlannedTree roots = plan_levels(below, parameters.root, surroundings, context, unbooked);
    result.is_complete = roots.is_complete;
    tell_unreachable(roots, parameters.unreachable, result.report);
    counts.add(roots.counts);
    parts.push_back(finished(roots, below.levels, Kind::root, parameters));
    watch.lap("roots");
  }
  result.report.groups.push_back(all_graphs_report(counts));

  context.report({.stage = "tree"});
  parts.insert(parts.begin(), finished(planned, plan.levels, Kind::stem, parameters));
  result.skeleton = parts.size() == 1 ? std::move(parts.front()) : joined(parts);
  watch.lap("tree");
  result.report.seconds = watch.seconds();
  return result;
}

void register_engine(EngineRegistry& registry) {
  registry.add<Engine>();
}

}  // namespace ramify::pathplan
