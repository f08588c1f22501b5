// The trees that are grown to be measured, and whether two of them are the same.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/lone_run.h"
#include "common/skeleton/skeleton.h"
#include "growth/parameters.h"

namespace ramify::bench {

/// The light model with Borchert-Honda allocation that grows to 640,000 internodes, with assignments
/// "KEY=VALUE" laid over it.
growth::Parameters trial_parameters(const std::vector<std::string>& assignments);

/// The first way in which two trees differ, a sentence: the number of nodes, a parent, or a position or
/// diameter by more than `tolerance` metres.
std::optional<std::string> difference(const Skeleton& a, const Skeleton& b, double tolerance);

/// "KEY=VALUE" for a tree such as the quickest public program grows by its own defaults: nothing is shed, V
/// is the gradient, found once a shoot, and shadows reach seven levels down. It grows some 5 voxels a step.
std::vector<std::string> unshed_assignments(int steps);

/// What a trial can be: growth/, the plain version, or that in a dense field, which takes unshed trees only.
inline constexpr const char* kGrowth = "growth";
inline constexpr const char* kPlain = "plain";
inline constexpr const char* kDense = "dense";

/// Grows the tree of a trial and measures that. Throws RunError if it does not get whole.
Outcome grow(const Trial& trial);

/// Grows trees of so many steps with growth/ and with the plain versions. The first difference, if any.
std::optional<std::string> plain_difference(const std::vector<int>& steps);

}  // namespace ramify::bench
