#include "bench/preset_parameters.h"

namespace ramify::bench {

std::vector<Override> overrides_of(const std::vector<std::string>& assignments) {
  std::vector<Override> overrides;
  for (const std::string& assignment : assignments) {
    const std::size_t equals = assignment.find('=');
    overrides.push_back({"bench", assignment.substr(0, equals), assignment.substr(equals + 1)});
  }
  return overrides;
}

}  // namespace ramify::bench
