// The growth engine: self-organizing trees after Palubicki et al. 2009.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/config/engine.h"
#include "growth/parameters.h"

namespace ramify::growth {

struct Engine {
  using Parameters = growth::Parameters;
  static constexpr std::string_view name = "growth";
  static constexpr bool has_history = true;
  static std::vector<std::string> layers(const Parameters& parameters) {
    return {parameters.environment == Environment::light ? "shadow" : "markers"};
  }

  static UsedVolumes volumes(const Parameters& parameters);

  static int steps(const Parameters& parameters) { return parameters.steps; }

  static std::vector<std::string> check(const Parameters& parameters);

  /// Layers: the shadow field after the last step, or the markers that are left. Progress: a call a step.
  static RunResult run(const Parameters& parameters, const RunContext& context);
};

void register_engine(EngineRegistry& registry);

}  // namespace ramify::growth
