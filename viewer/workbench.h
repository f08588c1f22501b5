// The state of the window: the trees that are open, how they are looked at, and what is being done.
#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/document.h"
#include "viewer/orbit.h"
#include "viewer/pane.h"
#include "viewer/panel.h"
#include "viewer/show_options.h"
#include "viewer/tree_distances.h"
#include "viewer/view.h"
#include "viewer/widget_report.h"
#include "viewer/window.h"

namespace ramify {

/// A config that is edited elsewhere at the same time.
struct FileWatch {
  std::filesystem::path path;
  std::filesystem::file_time_type changed;
};

/// A tree with its place in the window.
struct Seat {
  Seat(Opened opened, Pane own_pane);

  Document document;
  Panel panel;
  Pane pane;
  Orbit orbit;
  bool is_framed = false;  // until then the orbit waits for a tree to look at
  std::optional<FileWatch> watch;
  std::optional<double> next_step_at;  // while it plays
};

/// A question that a line of text answers.
struct Prompt {
  std::string title;
  std::string hint;
  std::string text;
  void (*answer)(struct Workbench& bench, const std::string& text) = nullptr;
};

struct Workbench {
  const ViewServices& services;
  Window& window;
  WidgetReport report;
  bool is_drawn_in_software;
  Programs programs = {};

  std::vector<std::unique_ptr<Seat>> seats = {};  // one or two
  std::vector<std::unique_ptr<Seat>> left =
      {};                  // replaced in this frame, which may still show their pictures
  std::size_t active = 0;  // whose parameters are shown
  ShowOptions show = {};
  bool are_cameras_linked = true;
  bool is_same_scale = false;
  bool are_parameters_linked = false;
  bool shows_help = false;
  bool shows_gallery = false;

  double last_motion = -1.0;   // when a slider or camera last moved
  bool is_drawn_fast = false;  // the pictures of this frame
  std::string message = {};    // about what was done last
  bool is_message_bad = false;
  std::optional<Prompt> prompt = {};
  TreeDistances distances = {};           // while numbers are shown
  std::future<std::string> writing = {};  // what is to be said when a file is written

  Pane new_pane() const { return Pane(programs, is_drawn_in_software); }
  Seat& seat() { return *seats[active]; }
  const Seat& seat() const { return *seats[active]; }
  Document& document() { return seat().document; }
  const Document& document() const { return seat().document; }
  bool is_moving() const;
  void say(std::string text, bool is_bad = false) {
    message = std::move(text);
    is_message_bad = is_bad;
  }
};

/// "A", "B": what the seats are called.
std::string seat_name(std::size_t index);

/// Opens a preset or file in a seat; index may be the number of seats, up to 2. Throws as ViewServices::open.
void open_in_seat(Workbench& bench, std::size_t index, const std::string& input);

/// Widths and heights of the panes follow from this: how many pictures there are.
std::size_t pane_count(const Workbench& bench);

/// What the picture of a seat is to have in sight: its tree, or both if they are overlaid, and what stands
/// beside to show their size. Empty while there is no tree.
std::vector<Vec3> points_in_sight(const Workbench& bench, const Seat& seat);

/// What is due without the user doing anything: trees that came, configs that changed on disk, the next step
/// of what plays. Returns the seconds until there may be more to do.
double tend(Workbench& bench);

/// Sleeps so many seconds, or until something happens in the window or a watched config changes on disk:
/// until then the picture is as it was.
void wait_for_change(Workbench& bench, double seconds);

/// Parameters of the active tree were changed by hand.
void take_edit(Workbench& bench, const WidgetOutcome& outcome, const Job& before);

}  // namespace ramify
