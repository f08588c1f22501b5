// The parts of path planning, each against another way of doing it, on one thread.
#pragma once

#include <optional>
#include <string>

#include "bench/results.h"

namespace ramify::bench {

/// Registers: from positions to costs, ours and with libraries; with random weights and with guiding vectors.
/// Nodes are made when first needed. `is_quick` leaves out 1 million.
void register_searches(Results& results, bool is_quick);

/// Their lines in the table.
void add_searches(GoalTable& table, const Results& results);

/// Finds least costs on graphs of ours with Boost.Graph too. The first node on which the two differ, if any.
std::optional<std::string> plain_cost_difference(int nodes);

}  // namespace ramify::bench
