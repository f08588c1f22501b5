// The trees that are grown to be measured, and whether two of them are the same.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/skeleton/skeleton.h"
#include "growth/parameters.h"

namespace ramify::bench {

/// The light model with Borchert-Honda allocation that grows to 640,000 internodes, with assignments
/// "KEY=VALUE" laid over it.
growth::Parameters trial_parameters(const std::vector<std::string>& assignments);

/// The first way in which two trees differ, a sentence: the number of nodes, a parent, or a position or
/// diameter by more than `tolerance` metres.
std::optional<std::string> difference(const Skeleton& a, const Skeleton& b, double tolerance);

/// Of positions, parents and diameters, to the last bit.
std::uint64_t fingerprint(const Skeleton& skeleton);

/// Grows trees of so many steps with growth/ and with the plain version. The first difference, if any.
std::optional<std::string> plain_difference(const std::vector<int>& steps);

}  // namespace ramify::bench
