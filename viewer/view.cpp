#include "viewer/view.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stop_token>

#include "common/base/errors.h"
#include "viewer/actions.h"
#include "viewer/commands.h"
#include "viewer/gallery.h"
#include "viewer/menus.h"
#include "viewer/seat_view.h"
#include "viewer/settings.h"
#include "viewer/sidebar.h"
#include "viewer/theme.h"
#include "viewer/window.h"
#include "viewer/workbench.h"

namespace ramify {
namespace {

constexpr float kSidebarWidth = 370.0f;  // of a plain display
constexpr float kSidebarShare = 0.4f;    // of the window at most

// ImGui needs a few frames to settle after an input.
constexpr double kAfterInput = 0.15;  // seconds
constexpr double kFrame = 0.016;

// Seconds that a frame takes without being noticed.
constexpr double kLongFrame = 0.03;

// The first frames find out how large everything is.
constexpr int kFirstFrames = 4;

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

/// A part of the window with its own content, without a frame.
template <class Content>
void area(const char* name, const ImVec2& low, const ImVec2& size, const ImVec2& padding,
          const Content& content) {
  ImGui::SetNextWindowPos(low);
  ImGui::SetNextWindowSize({std::max(1.0f, size.x), std::max(1.0f, size.y)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1.0f, 1.0f));
  const bool is_open = ImGui::Begin(name, nullptr, kFixed);
  ImGui::PopStyleVar(2);
  if (is_open) content();
  ImGui::End();
}

void lay_out(Workbench& bench, Gallery& gallery) {
  show_menus(bench);
  const ImGuiViewport& whole = *ImGui::GetMainViewport();
  const float scale = ui_scale();
  const float sidebar = std::floor(std::min(kSidebarWidth * scale, kSidebarShare * whole.WorkSize.x));
  const float status = ImGui::GetFrameHeight() + 2.0f * scale;
  const ImVec2 low = whole.WorkPos;
  const ImVec2 size(whole.WorkSize.x, std::max(1.0f, whole.WorkSize.y - status));
  const bool has_gallery = bench.shows_gallery && size.y > 3.0f * Gallery::height();
  const float strip = has_gallery ? Gallery::height() : 0.0f;
  area("pictures", low, {size.x - sidebar, size.y - strip}, {0.0f, 0.0f}, [&] { show_seats(bench); });
  if (has_gallery) {
    const bool is_busy = std::any_of(bench.seats.begin(), bench.seats.end(),
                                     [](const auto& seat) { return seat->document.work().is_busy; });
    area("presets", {low.x, low.y + size.y - strip}, {size.x - sidebar, strip}, {8.0f, 6.0f},
         [&] { gallery.show(bench, is_busy || bench.is_moving()); });
  }
  area("sidebar", {low.x + size.x - sidebar, low.y}, {sidebar, size.y}, ImGui::GetStyle().WindowPadding,
       [&] { show_sidebar(bench); });
  area("status", {low.x, low.y + size.y}, {size.x, status}, {10.0f * scale, 3.0f * scale},
       [&] { show_status(bench); });
  show_help(bench);
  show_prompt(bench);
}

/// Whether a picture gets finer without anything happening.
bool is_drawing(const Workbench& bench) {
  for (std::size_t index = 0; index < pane_count(bench); ++index) {
    if (bench.seats[index]->pane.is_unfinished()) return true;
  }
  return false;
}

/// What a driving program waits for. "TREE seat internodes draft|fine delay now": a tree is on show, so many
/// milliseconds after the input that changed it, at so many seconds; "PICTURE seat fast|fine triangles
/// milliseconds": it was drawn anew; "FRAME milliseconds": the window could not answer for so long; "READY":
/// all trees are on show, and at rest after that.
class Drive {
 public:
  /// After a frame, which began at that time.
  void tell(Workbench& bench, double begin) {
    if (!bench.report.is_on()) return;
    bench.report.flush();
    const double seconds = Window::now() - begin;
    if (seconds > kLongFrame) bench.report.say(fmt::format("FRAME {:.0f}", 1000.0 * seconds));
    bool is_drawn_anew = false;
    bool is_settled = !bench.is_drawn_fast && ImGui::GetFrameCount() >= kFirstFrames;
    for (std::size_t index = 0; index < bench.seats.size(); ++index) {
      const Document& document = bench.seats[index]->document;
      const Product* product = document.product();
      const Pane& pane = bench.seats[index]->pane;
      if (product != nullptr && pane.drawn_count() != drawn_[index]) {
        drawn_[index] = pane.drawn_count();
        is_drawn_anew = true;
        bench.report.say(fmt::format("PICTURE {} {} {} {:.1f}", seat_name(index),
                                     bench.is_drawn_fast ? "fast" : "fine", product->mesh.triangles.size(),
                                     1000.0 * pane.last_seconds()));
      }
      is_settled = is_settled && !is_drawing(bench) && (document.is_settled() || !document.error().empty());
      if (product == nullptr || product->serial == told_[index]) continue;
      told_[index] = product->serial;
      const double delay =
          document.product_edit_time() > 0.0 ? Window::now() - document.product_edit_time() : 0.0;
      bench.report.say(fmt::format("TREE {} {} {} {:.1f} {:.3f}", seat_name(index),
                                   product->skeleton.internode_count(), product->is_draft ? "draft" : "fine",
                                   1000.0 * delay, Window::now()));
    }
    if (is_settled && (!was_settled_ || is_drawn_anew)) bench.report.say("READY");
    was_settled_ = is_settled;
    if (const auto& now = bench.distances.values(); now != distances_ && !bench.distances.is_busy()) {
      bench.report.say(fmt::format("DISTANCES {:.4f}", fmt::join(*now, " ")));
      distances_ = now;
    }
    if (bench.message != message_) bench.report.say("MESSAGE " + bench.message);
    message_ = bench.message;
  }

 private:
  std::array<std::uint64_t, 2> told_{};
  std::array<std::size_t, 2> drawn_{};
  std::optional<TreeDistances::Values> distances_;
  std::string message_;
  bool was_settled_ = false;
};

void run(Workbench& bench) {
  Drive drive;
  Gallery gallery(bench.new_pane());
  const std::stop_callback waking(bench.services.stop, Window::wake);
  while (!bench.window.wants_to_close() && !bench.services.stop.stop_requested()) {
    const double begin = Window::now();
    bench.window.begin_frame();
    obey_keys(bench);
    if (const auto dropped = bench.window.take_dropped(); !dropped.empty()) open_dropped(bench, dropped);
    // What is held is not at rest.
    if (bench.is_moving() && ImGui::IsAnyItemActive()) bench.last_motion = Window::now();
    const double rest = tend(bench);
    lay_out(bench, gallery);
    bench.window.end_frame();
    bench.left.clear();
    drive.tell(bench, begin);
    if (bench.window.wants_to_close()) return;  // by a key or the menu: there is nothing to wait for
    const bool is_fresh =
        ImGui::GetFrameCount() < kFirstFrames || Window::now() - bench.window.last_input() < kAfterInput;
    wait_for_change(bench, is_drawing(bench) || gallery.is_drawing() ? 0.0
                           : is_fresh                                ? std::min(kFrame, rest)
                                                                     : rest);
  }
}

/// Whether the processor draws: then very many triangles take seconds.
bool is_software(const std::string& device) {
  return device.find("pipe") != std::string::npos;
}

void take_over(const Settings& settings, Workbench& bench) {
  bench.are_cameras_linked = settings.are_cameras_linked;
  bench.is_same_scale = settings.is_same_scale;
  bench.show.with_scale = settings.with_scale;
}

/// For the next time. What cannot be kept is no reason to fail.
void keep(Settings settings, const Workbench& bench, bool had_gallery) {
  bench.window.size(settings.width, settings.height);
  settings.width = std::clamp(settings.width, 200, 32'768);
  settings.height = std::clamp(settings.height, 200, 32'768);
  settings.are_cameras_linked = bench.are_cameras_linked;
  settings.is_same_scale = bench.is_same_scale;
  settings.with_scale = bench.show.with_scale;
  if (had_gallery) settings.shows_gallery = bench.shows_gallery;
  try {
    write_settings(settings, settings_file());
  } catch (const IoError& error) {
    fmt::print(stderr, "ramify: warning: the window's settings are not kept: {}\n", error.what());
  }
}

}  // namespace

void view(const ViewServices& services, const ViewOptions& options) {
  // What cannot be opened is told of before a window comes up.
  std::vector<Opened> opened;
  for (const std::string& input : options.inputs) opened.push_back(services.open(input));
  std::string problem;
  Settings settings = read_settings(settings_file(), problem);
  Window window("ramify", {options.width > 0 ? options.width : settings.width,
                           options.height > 0 ? options.height : settings.height, options.is_driven});
  Workbench bench{services, window, WidgetReport(options.is_driven), is_software(window.device())};
  if (!problem.empty()) bench.say(problem, true);
  take_over(settings, bench);
  if (!window.notice().empty()) bench.report.say("NOTICE " + window.notice());
  bench.shows_gallery = options.shows_gallery && settings.shows_gallery;
  for (Opened& tree : opened)
    bench.seats.push_back(std::make_unique<Seat>(std::move(tree), bench.new_pane()));
  bench.active = 0;
  run(bench);
  keep(settings, bench, options.shows_gallery);
  if (!window.gl_errors().empty()) throw RunError("OpenGL: " + window.gl_errors().front());
}

}  // namespace ramify
