#include "viewer/view.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <stop_token>

#include "common/base/errors.h"
#include "viewer/actions.h"
#include "viewer/commands.h"
#include "viewer/menus.h"
#include "viewer/seat_view.h"
#include "viewer/sidebar.h"
#include "viewer/window.h"
#include "viewer/workbench.h"

namespace ramify {
namespace {

constexpr float kSidebarWidth = 370.0f;  // of the plain font's size
constexpr float kSidebarShare = 0.4f;    // of the window at most

// ImGui needs a few frames to settle after an input.
constexpr double kAfterInput = 0.15;  // seconds
constexpr double kFrame = 0.016;

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

void lay_out(Workbench& bench) {
  show_menus(bench);
  const ImGuiViewport& whole = *ImGui::GetMainViewport();
  const float scale = ImGui::GetFontSize() / 15.0f;
  const float sidebar = std::floor(std::min(kSidebarWidth * scale, kSidebarShare * whole.WorkSize.x));
  const float status = ImGui::GetFrameHeight() + 2.0f;
  const ImVec2 low = whole.WorkPos;
  const ImVec2 size(whole.WorkSize.x, std::max(1.0f, whole.WorkSize.y - status));
  area("pictures", low, {size.x - sidebar, size.y}, {0.0f, 0.0f}, [&] { show_seats(bench); });
  area("sidebar", {low.x + size.x - sidebar, low.y}, {sidebar, size.y}, ImGui::GetStyle().WindowPadding,
       [&] { show_sidebar(bench); });
  area("status", {low.x, low.y + size.y}, {size.x, status}, {10.0f, 3.0f}, [&] { show_status(bench); });
  show_help(bench);
  show_prompt(bench);
}

/// What a driving program waits for: trees on show and at rest, and how long a change took.
class Drive {
 public:
  void tell(Workbench& bench) {
    if (!bench.report.is_on()) return;
    bench.report.flush();
    bool is_settled = !bench.is_moving() && ImGui::GetFrameCount() >= kFirstFrames;
    for (std::size_t index = 0; index < bench.seats.size(); ++index) {
      const Document& document = bench.seats[index]->document;
      const Product* product = document.product();
      is_settled = is_settled && (document.is_settled() || !document.error().empty());
      if (product == nullptr || product->serial == told_[index]) continue;
      told_[index] = product->serial;
      const double delay =
          document.product_edit_time() > 0.0 ? Window::now() - document.product_edit_time() : 0.0;
      bench.report.say(fmt::format("TREE {} {} {} {:.1f}", seat_name(index),
                                   product->skeleton.internode_count(), product->is_draft ? "draft" : "fine",
                                   1000.0 * delay));
    }
    if (is_settled && !was_settled_) bench.report.say("READY");
    was_settled_ = is_settled;
    if (bench.message != message_) bench.report.say("MESSAGE " + bench.message);
    message_ = bench.message;
  }

 private:
  std::array<std::uint64_t, 2> told_{};
  std::string message_;
  bool was_settled_ = false;
};

void run(Workbench& bench) {
  Drive drive;
  const std::stop_callback waking(bench.services.stop, Window::wake);
  while (!bench.window.wants_to_close() && !bench.services.stop.stop_requested()) {
    bench.window.begin_frame();
    obey_keys(bench);
    if (const auto dropped = bench.window.take_dropped(); !dropped.empty()) open_dropped(bench, dropped);
    const double rest = tend(bench);
    lay_out(bench);
    bench.window.end_frame();
    drive.tell(bench);
    const bool is_fresh =
        ImGui::GetFrameCount() < kFirstFrames || Window::now() - bench.window.last_input() < kAfterInput;
    bench.window.wait(is_fresh ? std::min(kFrame, rest) : rest);
  }
}

}  // namespace

void view(const ViewServices& services, const ViewOptions& options) {
  Window window("ramify", {options.width, options.height, options.is_driven});
  Workbench bench{services, window, WidgetReport(options.is_driven)};
  for (const std::string& input : options.inputs) open_in_seat(bench, bench.seats.size(), input);
  bench.active = 0;
  run(bench);
  if (!window.gl_errors().empty()) throw RunError("OpenGL: " + window.gl_errors().front());
}

}  // namespace ramify
