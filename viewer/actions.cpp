#include "viewer/actions.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/base/image.h"

namespace ramify {
namespace {

/// Runs `action`; what it throws is said.
template <class Action>
void attempt(Workbench& bench, const Action& action) {
  try {
    action();
  } catch (const std::exception& error) {
    bench.say(error.what(), true);
  }
}

void frame(Workbench& bench, Seat& seat) {
  const bool is_overlaid = bench.show.arrangement == Arrangement::overlaid;
  const Seat& shown = is_overlaid ? *bench.seats.front() : seat;
  seat.orbit = framed(seat.orbit, points_in_sight(bench, seat), shown.pane.aspect());
}

}  // namespace

void open_input(Workbench& bench, const std::string& input) {
  attempt(bench, [&] { open_in_seat(bench, bench.active, input); });
}

void open_beside(Workbench& bench, const std::string& input) {
  attempt(bench, [&] { open_in_seat(bench, bench.seats.size() < 2 ? 1 : 1 - bench.active, input); });
}

void open_dropped(Workbench& bench, const std::vector<std::string>& paths) {
  const std::size_t count = std::min<std::size_t>(paths.size(), 2);
  for (std::size_t index = 0; index < count; ++index) {
    attempt(bench, [&] { open_in_seat(bench, count == 1 ? bench.active : index, paths[index]); });
  }
}

void save_config(Workbench& bench, const std::string& path) {
  attempt(bench, [&] {
    Seat& seat = bench.seat();
    OutputFiles files;
    files.add(path) << to_toml(seat.document.job());
    files.commit();
    // Our own writing is no change made elsewhere.
    if (seat.watch && std::filesystem::equivalent(seat.watch->path, path)) {
      seat.watch->changed = std::filesystem::last_write_time(path);
    }
    bench.say(fmt::format("saved {}", path));
  });
}

void export_tree(Workbench& bench, const std::string& path) {
  const Product* product = bench.document().product();
  if (product == nullptr || !product->job || bench.writing.valid()) return;
  bench.say(fmt::format("writing {} ...", path));
  bench.writing = std::async(std::launch::async, [write = bench.services.write, job = product->job,
                                                  run = product->run, skeleton = product->skeleton, path] {
    write({*job, run, skeleton, path});
    Window::wake();
    return fmt::format("wrote {}", path);
  });
}

void take_screenshot(Workbench& bench) {
  attempt(bench, [&] {
    std::vector<Image> images;
    for (std::size_t index = 0; index < pane_count(bench); ++index) {
      images.push_back(bench.seats[index]->pane.image());
    }
    std::filesystem::path path;
    for (int number = 1; path.empty() || std::filesystem::exists(path); ++number) {
      path = fmt::format("ramify-{}.png", number);
    }
    OutputFiles files;
    write_png(contact_sheet(images, images.size()), files.add(path));
    files.commit();
    bench.say(fmt::format("saved {}", std::filesystem::absolute(path).string()));
  });
}

void copy_command(Workbench& bench) {
  const std::string command = generate_command(bench.document());
  bench.window.set_clipboard(command);
  bench.say("copied: " + command);
  bench.report.say("COMMAND " + command);
}

void look_from(Workbench& bench, double azimuth_deg, double elevation_deg) {
  move_cameras(bench, [&](Orbit orbit) {
    orbit.azimuth_deg = azimuth_deg;
    orbit.elevation_deg = elevation_deg;
    return orbit;
  });
  frame_trees(bench);
}

void frame_trees(Workbench& bench) {
  for (const auto& seat : bench.seats) {
    if (bench.are_cameras_linked || seat.get() == &bench.seat()) frame(bench, *seat);
  }
  if (bench.is_same_scale) equalize_scales(bench);
  bench.last_motion = Window::now();
}

void equalize_scales(Workbench& bench) {
  double farthest = 0.0;
  for (const auto& seat : bench.seats) farthest = std::max(farthest, seat->orbit.distance);
  for (const auto& seat : bench.seats) seat->orbit.distance = farthest;
}

void play_or_pause(Workbench& bench) {
  const bool plays = std::any_of(bench.seats.begin(), bench.seats.end(),
                                 [](const auto& seat) { return seat->next_step_at.has_value(); });
  for (const auto& seat : bench.seats) {
    seat->next_step_at.reset();
    Document& document = seat->document;
    if (plays || document.last_step() < 2) continue;
    if (document.step() >= document.last_step()) document.show_step(1, Window::now());
    seat->next_step_at = Window::now();
  }
}

void step_by(Workbench& bench, int steps) {
  Document& document = bench.document();
  if (document.last_step() == 0) return;
  const int last = static_cast<int>(document.last_step());
  const int step = std::clamp(static_cast<int>(document.step()) + steps, 1, last);
  bench.seat().next_step_at.reset();
  document.show_step(static_cast<std::uint32_t>(step), bench.window.last_input());
  bench.last_motion = Window::now();
}

void update_layers(Workbench& bench) {
  for (const auto& seat : bench.seats) {
    seat->document.want_layers({bench.show.layers.begin(), bench.show.layers.end()}, Window::now());
  }
}

}  // namespace ramify
