// The sidebar's page of what is shown, and the legend of colours.
#pragma once

#include "viewer/workbench.h"

namespace ramify {

/// Style, colours, overlays and scale, for all trees.
void show_choices(Workbench& bench);

/// Overlays that the open trees can have, in the order of their keys, F2 and on.
std::vector<std::string> overlays_of(const Workbench& bench);

void switch_overlay(Workbench& bench, const std::string& name);

/// What the colours of a seat's tree mean, with its lower right corner there; nothing if they mean nothing.
void show_legend(const Workbench& bench, std::size_t index, float right, float bottom);

}  // namespace ramify
