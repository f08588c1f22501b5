#include "viewer/schedule_editor.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/theme.h"

namespace ramify {
namespace {

using Points = std::vector<std::pair<double, double>>;

// Of a plain display.
constexpr float kHeight = 84.0f;
constexpr float kReach = 9.0f;  // from a point at which the mouse takes it

/// Between the plane of the schedule and the window's pixels.
struct Plot {
  ImVec2 low;  // upper left corner
  ImVec2 size;
  double last;
  SliderRange range;

  ImVec2 place(const std::pair<double, double>& point) const {
    const double height = (point.second - range.low) / (range.high - range.low);
    return {low.x + size.x * static_cast<float>(point.first / last),
            low.y + size.y * static_cast<float>(1.0 - height)};
  }

  /// Whole steps across, hundredths of the range up: values that look like somebody meant them.
  std::pair<double, double> point(const ImVec2& at, bool is_whole) const {
    double across = std::clamp(double(at.x - low.x) / size.x, 0.0, 1.0) * last;
    across = is_whole ? std::round(across) : std::round(across * 100.0) / 100.0;
    const double up = std::clamp(1.0 - double(at.y - low.y) / size.y, 0.0, 1.0);
    // By division, so that 0.57 is 0.57.
    const double steps = std::pow(10.0, 2.0 - std::floor(std::log10(range.high - range.low)));
    return {across, std::clamp(std::round((range.low + up * (range.high - range.low)) * steps) / steps,
                               range.low, range.high)};
  }
};

/// The point under the mouse, or -1.
int point_at(const Plot& plot, const Points& points, const ImVec2& mouse) {
  int nearest = -1;
  float least = kReach * ui_scale();
  for (std::size_t index = 0; index < points.size(); ++index) {
    const ImVec2 at = plot.place(points[index]);
    const float distance = std::hypot(at.x - mouse.x, at.y - mouse.y);
    if (distance < least) {
      least = distance;
      nearest = static_cast<int>(index);
    }
  }
  return nearest;
}

void draw_curve(const Plot& plot, const Schedule& schedule, int marked) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 high(plot.low.x + plot.size.x, plot.low.y + plot.size.y);
  list.AddRectFilled(plot.low, high, ImGui::GetColorU32(ImGuiCol_FrameBg), 3.0f);
  // With room for all of a point on the edge.
  const float edge = 5.0f * ui_scale();
  list.PushClipRect({plot.low.x - edge, plot.low.y - edge}, {high.x + edge, high.y + edge}, true);
  const ImU32 line = ImGui::GetColorU32(ImGuiCol_PlotLines);
  constexpr int kPieces = 64;
  std::vector<ImVec2> curve;
  for (int piece = 0; piece <= kPieces; ++piece) {
    const double across = plot.last * piece / kPieces;
    curve.push_back(plot.place({across, schedule.at(across)}));
  }
  list.AddPolyline(curve.data(), static_cast<int>(curve.size()), line, 0, 1.5f * ui_scale());
  for (std::size_t index = 0; index < schedule.points().size(); ++index) {
    const float radius = static_cast<int>(index) == marked ? 5.0f : 3.5f;
    list.AddCircleFilled(plot.place(schedule.points()[index]), radius * ui_scale(), line);
  }
  list.PopClipRect();
}

/// Moves a point, between its neighbours.
void move_point(Points& points, std::size_t index, std::pair<double, double> to, double gap) {
  if (index > 0) to.first = std::max(to.first, points[index - 1].first + gap);
  if (index + 1 < points.size()) to.first = std::min(to.first, points[index + 1].first - gap);
  points[index] = to;
}

void add_point(Points& points, const std::pair<double, double>& point) {
  const auto after = std::find_if(points.begin(), points.end(),
                                  [&](const auto& other) { return other.first >= point.first; });
  if (after != points.end() && after->first == point.first) {
    after->second = point.second;
  } else {
    points.insert(after, point);
  }
}

}  // namespace

WidgetOutcome schedule_curve(const char* id, Schedule& schedule, double last, const SliderRange& range) {
  Points points = schedule.points();
  last = std::max({last, points.back().first, 1e-3});
  const bool is_whole = last > 3.0;  // steps rather than parts of a way
  const Plot plot{
      ImGui::GetCursorScreenPos(), {ImGui::GetContentRegionAvail().x, kHeight * ui_scale()}, last, range};
  ImGui::InvisibleButton(id, plot.size);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  // Which point is dragged is kept by ImGui under this widget's name.
  int& dragged = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("dragged"), -1);
  WidgetOutcome outcome;
  // Where it was let go counts, too: a busy window may have missed the way there.
  const bool is_held = ImGui::IsItemActive() || ImGui::IsItemDeactivated();
  const ImVec2 pressed = ImGui::GetIO().MouseClickedPos[0];
  const int under = ImGui::IsItemHovered() ? point_at(plot, points, mouse) : -1;
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0) && under < 0) {
    add_point(points, plot.point(mouse, is_whole));
    outcome = {true, true};
  } else if (ImGui::IsItemHovered() && ImGui::IsMouseClicked(1) && under >= 0 && points.size() > 1) {
    points.erase(points.begin() + under);
    outcome = {true, true};
  } else if (ImGui::IsItemActivated()) {
    dragged = under;
  } else if (is_held && dragged >= 0 && dragged < static_cast<int>(points.size()) &&
             std::hypot(mouse.x - pressed.x, mouse.y - pressed.y) > 1.0f) {
    move_point(points, static_cast<std::size_t>(dragged), plot.point(mouse, is_whole), is_whole ? 1.0 : 0.01);
    outcome.is_changed = points != schedule.points();
  }
  if (ImGui::IsItemDeactivated()) {
    outcome.is_finished = dragged >= 0;
    dragged = -1;
  }
  if (outcome.is_changed) schedule = Schedule(points);
  const int marked = dragged >= 0 ? dragged : under;
  draw_curve(plot, schedule, marked);
  if (marked >= 0 && marked < static_cast<int>(schedule.points().size())) {
    const auto& [step, value] = schedule.points()[static_cast<std::size_t>(marked)];
    ImGui::SetTooltip("%.4g: %.4g", step, value);
  } else if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("Drag a point; double click adds one, right click takes one away");
  }
  return outcome;
}

}  // namespace ramify
