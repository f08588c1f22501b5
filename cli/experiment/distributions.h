// Distributions of several trees over the same bins, for plots and tables.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/experiment/comparison.h"
#include "cli/experiment/plots.h"

namespace ramify::cli {

/// A plot of one quantity, a series a subject, its trees taken together, and what is to be said of it.
struct DistributionPlot {
  Plot plot;
  std::string heading;                 // "Branching angles"
  std::vector<std::string> summaries;  // a subject each, in words
};

/// Branching angle, axis length and path length as shares of a bin; width by branch order. Quantities that no
/// subject has are left out.
std::vector<DistributionPlot> distribution_plots(std::span<const Subject> subjects);

}  // namespace ramify::cli
