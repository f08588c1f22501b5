#include "bench/planned_trees.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "bench/fingerprint.h"
#include "bench/preset_parameters.h"
#include "common/base/errors.h"
#include "common/config/presets.h"
#include "pathplan/engine.h"
#include "pathplan/threshold_graph.h"
#include "pathplan/yao_graph.h"

namespace ramify::bench {
namespace {

using namespace pathplan;

constexpr const char* kOneLevel = "xm12-fig5";
constexpr const char* kFourLevels = "xm12-table1-351k";

// XM12 Fig. 22: 33,000 nodes, 1,500 endpoints.
constexpr int kNodesPerEndpoint = 22;

// In spacings, the engine's default.
constexpr double kMaxEdge = 3.0;

double reported(const Report& report, const std::string& group, const std::string& key) {
  for (const ReportGroup& candidate : report.groups) {
    if (candidate.name != group) continue;
    for (const auto& [name, value] : candidate.values) {
      if (name == key) return value;
    }
  }
  throw RunError(fmt::format("no {}.{} in the report", group, key));
}

Volume mushroom() {
  return preset_parameters<Engine>(kOneLevel, {}).levels.front().volume;
}

}  // namespace

Trial one_graph_trial(int nodes) {
  return {
      .work = kOneLevel,
      .assignments = {fmt::format("pathplan.levels=[{{nodes={}, b={}}}]", nodes, nodes / kNodesPerEndpoint)}};
}

Trial four_level_trial(int threads) {
  if (find_preset(kFourLevels)) return {.work = kFourLevels, .threads = threads};
  const std::string levels =
      "[{nodes=28710, b=30},"
      " {nodes=500, b=13, r=2, a=0.6, alpha_deg=54, endpoints=\"random\"},"
      " {nodes=150, b=8, r=2, a=0.6, alpha_deg=54, endpoints=\"random\"},"
      " {nodes=80, b=10, r=2, a=0.6, alpha_deg=54, endpoints=\"random\"}]";
  return {.work = kOneLevel, .threads = threads, .assignments = {"pathplan.levels=" + levels}};
}

Outcome plan(const Trial& trial) {
  const Parameters parameters = preset_parameters<Engine>(trial.work, trial.assignments);
  RunResult result;
  Outcome outcome = measured([&] { result = Engine::run(parameters, {}); });
  if (!result.is_complete) throw RunError("stopped");
  outcome.count = reported(result.report, "all_graphs", "nodes");
  outcome.skeleton = fingerprint(result.skeleton);
  return outcome;
}

Mushroom::Mushroom(int count)
    : volume(mushroom()),
      solid(volume),
      domain{solid, surroundings},
      nodes(scatter_nodes(volume, Vec3(0.0), {.nodes = count})) {}

Graph Mushroom::graph(std::vector<Vec3> positions, int sectors) const {
  const EdgeRules rules(domain, positions, kMaxEdge * nodes.spacing);
  Graph graph;
  graph.edges = yao_edges(positions, rules, sectors, nodes.spacing);
  graph.nodes = std::move(positions);
  assign_random_weights(graph, kWeights);
  link_nodes(graph);
  return graph;
}

std::vector<Edge> Mushroom::edges_within(double metres) const {
  const EdgeRules rules(domain, nodes.position, metres);
  return threshold_edges(nodes.position, rules);
}

}  // namespace ramify::bench
