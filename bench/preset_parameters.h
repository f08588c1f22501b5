// A preset's parameters with assignments laid over them.
#pragma once

#include <string>
#include <vector>

#include "common/config/job.h"

namespace ramify::bench {

/// Of assignments "KEY=VALUE".
std::vector<Override> overrides_of(const std::vector<std::string>& assignments);

/// Throws ConfigError if they do not fit the engine.
template <class Engine>
typename Engine::Parameters preset_parameters(const std::string& preset,
                                              const std::vector<std::string>& assignments) {
  EngineRegistry registry;
  registry.add<Engine>();
  const Job job = load_job(registry, preset, overrides_of(assignments));
  return *static_cast<const typename Engine::Parameters*>(job.parameters.get());
}

}  // namespace ramify::bench
