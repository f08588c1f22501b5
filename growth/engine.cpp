#include "growth/engine.h"

#include <fmt/format.h>

#include "common/base/errors.h"
#include "growth/parameter_check.h"
#include "growth/simulation.h"
#include "growth/tree_skeleton.h"

namespace ramify::growth {
namespace {

std::string limit_warning(const Parameters& parameters, const Simulation& simulation) {
  return fmt::format(
      "stopped after step {} with {} internodes: the next step would make more than growth.max_internodes = "
      "{}",
      simulation.step(), simulation.internode_count(), parameters.max_internodes);
}

Skeleton skeleton_of(std::vector<GrowingTree> trees, const Parameters& parameters) {
  if (trees.size() == 1) return skeleton_of(std::move(trees.front()), parameters);
  std::vector<Skeleton> skeletons;
  for (GrowingTree& tree : trees) skeletons.push_back(skeleton_of(std::move(tree), parameters));
  return joined(skeletons);
}

}  // namespace

UsedVolumes Engine::volumes(const Parameters& parameters) {
  UsedVolumes used;
  for (const Obstacle& obstacle : parameters.obstacles) {
    // What shades alone, a forest around, would hide the tree.
    if (obstacle.blocks) {
      used.obstacles.push_back(&obstacle.volume);
    } else if (obstacle.shadow > 0.0) {
      used.others.push_back(&obstacle.volume);
    }
  }
  if (parameters.environment == Environment::space) used.others.push_back(&parameters.markers.volume);
  for (const PruneEvent& event : parameters.prune) {
    if (event.step <= parameters.steps) used.others.push_back(&event.volume);
  }
  return used;
}

std::vector<std::string> Engine::check(const Parameters& parameters) {
  return check_parameters(parameters);
}

RunResult Engine::run(const Parameters& parameters, const RunContext& context) {
  RunResult result;
  Simulation simulation(parameters, context.wants_history);
  while (simulation.step() < parameters.steps) {
    if (context.stop.stop_requested()) {
      result.is_complete = false;
      break;
    }
    if (!simulation.advance()) {
      result.is_complete = false;
      result.report.warnings.push_back(limit_warning(parameters, simulation));
      break;
    }
    context.report({"growing", double(simulation.step()), double(parameters.steps), "step"});
  }

  simulation.sense();  // so that the youngest internodes have light and vigour too
  if (context.wants("shadow") && !simulation.markers())
    result.layers.push_back({"shadow", simulation.shadow().layer()});
  if (context.wants("markers") && simulation.markers()) {
    result.layers.push_back({"markers", simulation.markers()->layer()});
  }
  result.report.seconds = simulation.stopwatch().seconds();
  result.skeleton = skeleton_of(simulation.take_trees(), parameters);
  return result;
}

void register_engine(EngineRegistry& registry) {
  registry.add<Engine>();
}

}  // namespace ramify::growth
