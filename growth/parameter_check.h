// What no single range can say about growth parameters.
#pragma once

#include <string>
#include <vector>

#include "growth/parameters.h"

namespace ramify::growth {

/// Throws ConfigError with the key, below `growth`, of what cannot be; returns warnings, one line each, about
/// what will hardly be meant.
std::vector<std::string> check_parameters(const Parameters& parameters);

}  // namespace ramify::growth
