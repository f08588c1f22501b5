// The panel beside the pictures: the active tree's parameters, and what is shown of it.
#pragma once

#include "viewer/workbench.h"

namespace ramify {

/// Draws it into the ImGui window that is open.
void show_sidebar(Workbench& bench);

}  // namespace ramify
