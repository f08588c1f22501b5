// What the parameters' ranges cannot say: how they go together.
#pragma once

#include <string>
#include <vector>

#include "pathplan/parameters.h"

namespace ramify::pathplan {

/// Throws ConfigError for the first thing that cannot be, with its key below the engine's table, such as
/// "levels.1.sectors"; returns warnings. Looks into the volumes on a grid: some milliseconds a level.
std::vector<std::string> check_parameters(const Parameters& parameters);

}  // namespace ramify::pathplan
