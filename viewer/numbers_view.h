// The sidebar's page of numbers.
#pragma once

#include "viewer/workbench.h"

namespace ramify {

/// Metrics of all trees, their difference where there are two, and histograms of the active one.
void show_numbers(Workbench& bench);

}  // namespace ramify
