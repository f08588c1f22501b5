// What commands do to the trees and to files.
#pragma once

#include <string>

#include "viewer/workbench.h"

namespace ramify {

/// The answers to prompts: a file or preset to open in the active seat, or beside it; files to write. What
/// goes wrong becomes the window's message.
void open_input(Workbench& bench, const std::string& input);
void open_beside(Workbench& bench, const std::string& input);
void save_config(Workbench& bench, const std::string& path);
void export_tree(Workbench& bench, const std::string& path);

/// Each in a seat of its own, as far as there are seats.
void open_dropped(Workbench& bench, const std::vector<std::string>& paths);

/// A PNG of all panes beside each other, without the widgets, under the first free name.
void take_screenshot(Workbench& bench);

void copy_command(Workbench& bench);

/// Looks at the whole tree from a side, with all cameras if they are linked.
void look_from(Workbench& bench, double azimuth_deg, double elevation_deg);
void frame_trees(Workbench& bench);

/// All cameras as far away as the farthest, so that a metre is as long in each picture.
void equalize_scales(Workbench& bench);

/// Moves the active camera, and the other if they are linked.
template <class Move>
void move_cameras(Workbench& bench, const Move& move) {
  for (const auto& seat : bench.seats) {
    if (bench.are_cameras_linked || seat.get() == &bench.seat()) seat->orbit = move(seat->orbit);
  }
  bench.last_motion = Window::now();
}

void play_or_pause(Workbench& bench);

/// Steps the shown tree on or back.
void step_by(Workbench& bench, int steps);

/// After the layers on show have changed.
void update_layers(Workbench& bench);

}  // namespace ramify
