#include "viewer/workbench.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "common/base/errors.h"
#include "common/config/differences.h"
#include "common/config/inheritance.h"
#include "common/config/presets.h"
#include "common/config/toml_reader.h"
#include "viewer/annotations.h"
#include "viewer/scene.h"

namespace ramify {
namespace {

constexpr double kRest = 0.3;         // seconds after which what moved counts as at rest
constexpr double kWatchEvery = 0.5;   // seconds
constexpr double kFrameEvery = 20.0;  // seconds, though nothing happens: whatever covered the window is gone
constexpr double kPlayEvery = 0.35;   // seconds a step

std::optional<FileWatch> watch_of(const Opened& opened) {
  std::error_code error;
  if (!opened.job || find_preset(opened.input) != nullptr) return std::nullopt;
  const auto changed = std::filesystem::last_write_time(opened.input, error);
  if (error) return std::nullopt;
  return FileWatch{opened.input, changed};
}

Panel panel_of(const Opened& opened) {
  Panel panel;
  if (opened.job) panel.defaults = default_job(*opened.job->engine);
  return panel;
}

/// When a watched config's file changed, if it did since it was read.
std::optional<std::filesystem::file_time_type> change_of(const Seat& seat) {
  if (!seat.watch) return std::nullopt;
  std::error_code error;
  const auto changed = std::filesystem::last_write_time(seat.watch->path, error);
  // Editors take a file away before they put the new one there.
  if (error || changed == seat.watch->changed) return std::nullopt;
  return changed;
}

/// Reads a watched config again if its file changed.
void look_at_file(Workbench& bench, Seat& seat) {
  const auto changed = change_of(seat);
  if (!changed) return;
  seat.watch->changed = *changed;
  try {
    Opened opened = bench.services.open(seat.watch->path.string());
    if (!opened.job) return;
    const bool is_other_engine = opened.job->engine != seat.document.job().engine;
    if (is_other_engine) seat.panel = panel_of(opened);
    seat.document.replace(std::move(*opened.job), Window::now());
    bench.say(fmt::format("{} was read again", seat.watch->path.string()));
  } catch (const std::exception& problem) {
    seat.document.fail(problem.what());
  }
}

void play(Workbench& bench, Seat& seat) {
  if (!seat.next_step_at || Window::now() < *seat.next_step_at) return;
  Document& document = seat.document;
  if (document.step() >= document.last_step()) {
    seat.next_step_at.reset();
    return;
  }
  document.show_step(document.step() + 1, Window::now());
  bench.last_motion = Window::now();
  seat.next_step_at = Window::now() + kPlayEvery;
}

/// Lays what changed in one job over another of the same engine.
void change_alike(Job& job, const std::vector<Assignment>& changes) {
  const Table table = job_table(*job.engine);
  for (const auto& [key, value] : changes) {
    Origins origins;
    try {
      assign(table, &job, key, value, "", origins);
    } catch (const ConfigError&) {
      // An item that the other tree does not have stays alone.
    }
  }
}

void finish_writing(Workbench& bench) {
  if (!bench.writing.valid()) return;
  if (bench.writing.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  try {
    bench.say(bench.writing.get());
  } catch (const std::exception& error) {
    bench.say(error.what(), true);
  }
}

}  // namespace

Seat::Seat(Opened opened, Pane own_pane)
    : document(opened, Window::wake),
      panel(panel_of(opened)),
      pane(std::move(own_pane)),
      watch(watch_of(opened)) {
  orbit.elevation_deg = 5.0;
}

bool Workbench::is_moving() const {
  return Window::now() - last_motion < kRest;
}

std::string seat_name(std::size_t index) {
  return std::string(1, static_cast<char>('A' + index));
}

void open_in_seat(Workbench& bench, std::size_t index, const std::string& input) {
  auto seat = std::make_unique<Seat>(bench.services.open(input), bench.new_pane());
  if (index < bench.seats.size()) {
    seat->orbit = bench.seats[index]->orbit;
    bench.left.push_back(std::exchange(bench.seats[index], std::move(seat)));
  } else {
    if (!bench.seats.empty()) seat->orbit = bench.seats.front()->orbit;
    bench.seats.push_back(std::move(seat));
  }
  bench.active = std::min(index, bench.seats.size() - 1);
  bench.seat().document.want_layers({bench.show.layers.begin(), bench.show.layers.end()}, 0.0);
}

std::size_t pane_count(const Workbench& bench) {
  return bench.show.arrangement == Arrangement::overlaid ? 1 : bench.seats.size();
}

std::vector<Vec3> points_in_sight(const Workbench& bench, const Seat& seat) {
  const bool is_overlaid = bench.show.arrangement == Arrangement::overlaid;
  std::vector<Vec3> points;
  Box box;
  std::optional<Vec3> base;
  for (const auto& other : bench.seats) {
    const Product* product = other->document.product();
    if (product == nullptr || product->box.is_empty() || (!is_overlaid && other.get() != &seat)) continue;
    const std::vector<Vec3> own = framing_points(*product);
    points.insert(points.end(), own.begin(), own.end());
    box.include(product->box);
    if (!base) base = base_of({.skeleton = &product->skeleton, .outline = product->outline});
  }
  if (!bench.show.with_scale || !base) return points;
  const Annotations beside = annotations_beside(box, *base, seat.orbit.azimuth_deg);
  const CameraAxes axes = camera_axes(seat.orbit.azimuth_deg, 0.0);
  for (const std::vector<Vec2f>* shape : {&beside.figure, &beside.bar}) {
    for (const Vec2f& corner : *shape) points.push_back(*base + axes.world(Vec3(corner, 0.0)));
  }
  return points;
}

double tend(Workbench& bench) {
  double wait = kFrameEvery;
  const double now = Window::now();
  for (const auto& seat : bench.seats) {
    look_at_file(bench, *seat);
    play(bench, *seat);
    seat->document.update(now, !bench.is_moving());
    if (seat->next_step_at) wait = std::min(wait, *seat->next_step_at - now);
    if (const auto due = seat->document.due_in(now)) wait = std::min(wait, *due);
  }
  finish_writing(bench);
  if (bench.writing.valid() || bench.distances.is_busy()) wait = std::min(wait, 0.1);
  if (bench.is_moving()) wait = std::min(wait, bench.last_motion + kRest - now);
  return std::max(wait, 0.001);
}

void wait_for_change(Workbench& bench, double seconds) {
  const auto has_changed = [&] {
    return std::any_of(bench.seats.begin(), bench.seats.end(),
                       [](const auto& seat) { return change_of(*seat); });
  };
  const double end = Window::now() + seconds;
  do {
    const double left = std::max(0.0, end - Window::now());
    if (bench.window.wait(std::min(left, kWatchEvery)) || has_changed()) return;
  } while (Window::now() < end);
}

void take_edit(Workbench& bench, const WidgetOutcome& outcome, const Job& before) {
  if (!outcome.is_changed && !outcome.is_finished) return;
  const double at = bench.window.last_input();
  std::vector<Seat*> changed{&bench.seat()};
  Job& job = bench.document().job();
  if (outcome.is_changed) {
    Job old = independent_copy(before);
    follow_owner(job_table(*job.engine), &old, &job);
  }
  if (outcome.is_changed && bench.are_parameters_linked) {
    const std::vector<Assignment> changes = differences(job_table(*job.engine), &before, &job);
    for (const auto& seat : bench.seats) {
      const bool is_other = seat.get() != &bench.seat() && seat->document.has_job();
      if (!is_other || seat->document.job().engine != job.engine) continue;
      change_alike(seat->document.job(), changes);
      changed.push_back(seat.get());
    }
  }
  for (Seat* seat : changed) {
    if (outcome.is_changed) seat->document.edited(at);
    if (outcome.is_finished) seat->document.settle();
  }
  bench.last_motion = Window::now();
}

}  // namespace ramify
