#include "pathplan/engine.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/base/errors.h"
#include "common/base/stopwatch.h"
#include "pathplan/edge_rules.h"
#include "pathplan/endpoints.h"
#include "pathplan/graph.h"
#include "pathplan/parameter_check.h"
#include "pathplan/poisson_disc.h"
#include "pathplan/shortest_paths.h"
#include "pathplan/tree.h"
#include "pathplan/weights.h"
#include "pathplan/yao_graph.h"

namespace ramify::pathplan {
namespace {

Graph make_graph(const Level& level, Nodes nodes, std::uint64_t seed, const std::stop_token& stop) {
  Graph graph;
  graph.nodes = std::move(nodes.position);
  const EdgeRules rules(level.volume, graph.nodes, level.max_edge * nodes.spacing);
  graph.edges = yao_edges(graph.nodes, rules, level.sectors, nodes.spacing, stop);
  assign_random_weights(
      graph,
      {.exponent = level.weight_exponent, .low = level.weight_low, .high = level.weight_high, .seed = seed});
  link_nodes(graph);
  return graph;
}

/// Throws unless all endpoints are reached.
void require_reached(const ShortestPaths& paths, std::span<const std::uint32_t> endpoints, double max_edge) {
  const auto unreachable = std::count_if(endpoints.begin(), endpoints.end(),
                                         [&](std::uint32_t node) { return !paths.is_reached(node); });
  if (unreachable == 0) return;
  throw RunError(
      fmt::format("{} of {} endpoints cannot be reached from the root (edges are at most {:.3g} m long: "
                  "raise nodes or max_edge, or make the volume's thin places and overlaps wider)",
                  unreachable, endpoints.size(), max_edge));
}

ReportGroup graph_statistics(const Graph& graph, const ShortestPaths& paths) {
  const bool is_connected =
      std::none_of(paths.cost.begin(), paths.cost.end(), [](double c) { return c == kUnreached; });
  const auto nodes = static_cast<double>(graph.nodes.size());
  const auto edges = static_cast<double>(graph.edges.size());
  return {"graph",
          {{"nodes", nodes},
           {"edges", edges},
           {"edges_per_node", edges / nodes},
           {"components", is_connected ? 1.0 : static_cast<double>(component_count(graph))},
           {"unreachable", 0.0}}};  // a run with unreachable endpoints throws
}

Layer graph_layer(const Graph& graph) {
  return {"graph", LineLayer{.points = graph.nodes,
                             .point_values = std::vector<double>(graph.nodes.size(), 0.0),
                             .lines = graph.edges,
                             .values = {graph.weights.begin(), graph.weights.end()}}};
}

Layer endpoint_layer(const Graph& graph, std::span<const std::uint32_t> endpoints) {
  PointLayer layer;
  for (const std::uint32_t node : endpoints) layer.points.push_back(graph.nodes[node]);
  return {"endpoints", std::move(layer)};
}

/// Everything but a stopped run's skeleton; false if the run is stopped.
bool plan(const Parameters& parameters, const Taper& taper, const RunContext& context, RunResult& result) {
  const Level& level = parameters.levels.front();
  const std::uint64_t seed = parameters.seed;
  Stopwatch watch;

  Nodes nodes = scatter_nodes(level.volume, parameters.root,
                              {.nodes = level.nodes, .spacing = level.spacing, .seed = seed}, context.stop,
                              [&](double done, double total) {
                                context.report({"nodes", done, total, "node"});
                              });
  if (context.stop.stop_requested()) return false;
  const double max_edge = level.max_edge * nodes.spacing;
  const std::vector<std::uint32_t> endpoints = choose_endpoints(nodes.position, level, seed);

  watch.lap("nodes");
  context.report({.stage = "graph"});
  const Graph graph = make_graph(level, std::move(nodes), seed, context.stop);
  if (context.stop.stop_requested()) return false;

  watch.lap("graph");
  context.report({.stage = "paths"});
  const ShortestPaths paths = shortest_paths(graph, 0, context.stop);
  if (context.stop.stop_requested()) return false;
  require_reached(paths, endpoints, max_edge);
  result.report.groups.push_back(graph_statistics(graph, paths));

  watch.lap("paths");
  context.report({.stage = "tree"});
  result.skeleton = make_tree(graph, paths, endpoints, taper);
  if (context.wants("graph")) result.layers.push_back(graph_layer(graph));
  if (context.wants("endpoints")) result.layers.push_back(endpoint_layer(graph, endpoints));
  watch.lap("tree");
  result.report.seconds = watch.seconds();
  return true;
}

}  // namespace

std::vector<std::string> Engine::check(const Parameters& parameters) {
  return check_parameters(parameters);
}

RunResult Engine::run(const Parameters& parameters, const RunContext& context) {
  const Taper taper{.zeta = parameters.levels.front().zeta,
                    .trunk_diameter = parameters.trunk_diameter,
                    .tip_diameter = parameters.tip_diameter};
  RunResult result;
  result.is_complete = plan(parameters, taper, context, result);
  if (!result.is_complete) result.skeleton = bare_root(parameters.root, taper);
  return result;
}

void register_engine(EngineRegistry& registry) {
  registry.add<Engine>();
}

}  // namespace ramify::pathplan
