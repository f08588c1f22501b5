// The growth engine: self-organizing trees after Palubicki et al. 2009.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "common/config/engine.h"
#include "growth/parameters.h"

namespace ramify::growth {

struct Engine {
  using Parameters = growth::Parameters;
  static constexpr std::string_view name = "growth";
  static constexpr std::array<std::string_view, 2> layers = {"shadow", "markers"};

  static int steps(const Parameters& parameters) { return parameters.steps; }

  static std::vector<std::string> check(const Parameters& parameters);

  /// Layers: "shadow", the shadow field after the last step, and "markers", those that are left; neither is
  /// where the environment has none. Progress: a call a step.
  static RunResult run(const Parameters& parameters, const RunContext& context);
};

void register_engine(EngineRegistry& registry);

}  // namespace ramify::growth
