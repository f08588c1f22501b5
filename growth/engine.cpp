#include "growth/engine.h"

#include <fmt/format.h>

#include "common/base/errors.h"
#include "common/skeleton/passes.h"
#include "growth/simulation.h"

namespace ramify::growth {
namespace {

std::string limit_warning(const Parameters& parameters, const Simulation& simulation) {
  return fmt::format(
      "stopped after step {} of {} with {} internodes: the next step would make more than "
      "growth.max_internodes = {}",
      simulation.step(), parameters.steps, simulation.plant().internode_count(), parameters.max_internodes);
}

}  // namespace

std::vector<std::string> Engine::check(const Parameters& parameters) {
  for (const auto& [name, tropism] : parameters.tropism) {
    if (glm::length(tropism.direction) < 1e-6) {
      throw ConfigError("", fmt::format("tropism.{}.direction", name),
                        "[0, 0, 0] points nowhere (any other vector)");
    }
  }
  for (const auto& [step, w_min] : parameters.w_min.points()) {
    if (w_min > parameters.w_max.at(step)) {
      throw ConfigError("", "w_min",
                        fmt::format("{} is more than w_max at step {} (at most {})", w_min, step,
                                    parameters.w_max.at(step)));
    }
  }
  std::vector<std::string> warnings;
  const double first_vigour = parameters.alpha0.at(1) + parameters.alpha.at(1) * parameters.C.at(1);
  if (first_vigour < 1.0) {
    warnings.push_back(fmt::format(
        "growth.alpha: the tree stays a seed: alpha0 + alpha * C = {} at step 1 (a shoot takes 1)",
        first_vigour));
  }
  return warnings;
}

RunResult Engine::run(const Parameters& parameters, const RunContext& context) {
  RunResult result;
  Simulation simulation(parameters);
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
  result.skeleton = to_skeleton(simulation.plant(), parameters, simulation.light(), simulation.vigour());
  if (!context.wants_history) result.skeleton = living(result.skeleton);
  if (context.wants("shadow")) result.layers.push_back({"shadow", simulation.shadow().layer()});
  result.report.seconds = simulation.stopwatch().seconds();
  return result;
}

void register_engine(EngineRegistry& registry) {
  registry.add<Engine>();
}

}  // namespace ramify::growth
