// The parts of growth, each against the plain way of doing it, on one thread.
#pragma once

#include "bench/results.h"

namespace ramify::bench {

namespace component {
inline constexpr const char* kCastGrid = "shadow/all-casters/grid";
inline constexpr const char* kCastAccessor = "shadow/all-casters/accessor";
inline constexpr const char* kCastChanges = "shadow/all-steps/changes";
inline constexpr const char* kCastAnew = "shadow/all-steps/anew";
inline constexpr const char* kPassesFlat = "passes/flat";
inline constexpr const char* kPassesRecursive = "passes/recursive";
inline constexpr const char* kAllocatePriority = "passes/flat-priority";
}  // namespace component

/// Registers the work named above, on a tree of so many steps. The trees are grown when first needed.
void register_components(Results& results, int steps);

/// Their lines in the table.
void add_components(GoalTable& table, const Results& results);

}  // namespace ramify::bench
