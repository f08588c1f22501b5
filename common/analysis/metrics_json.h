// Metrics as JSON, for `ramify stats` and for the files that carry them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "common/analysis/metrics.h"

namespace ramify {

/// An object of all metrics by key, with the list `by_order`; null for what the tree does not define.
nlohmann::ordered_json metrics_json(const Metrics& metrics);

}  // namespace ramify
