// Growth configs and what tests measure on the trees they make.
#pragma once

#include <string>
#include <vector>

#include "common/config/job.h"
#include "growth/parameters.h"

namespace ramify::test {

/// The parameters of a growth preset with assignments "KEY=VALUE" laid over it.
growth::Parameters growth_parameters(const std::string& preset,
                                     const std::vector<std::string>& assignments = {});

/// All presets of the growth engine.
std::vector<std::string> growth_presets();

/// Horizontal place of the wood's centre of mass over the tree's height; its length is the metric `lean`.
Vec3 relative_center_of_mass(const Skeleton& skeleton);

double median(std::vector<double> values);

}  // namespace ramify::test
