// A tree's picture in the window, with the mouse on it and its steps below.
#pragma once

#include "viewer/workbench.h"

namespace ramify {

/// Draws the panes of all seats into the ImGui window that is open, side by side.
void show_seats(Workbench& bench);

}  // namespace ramify
