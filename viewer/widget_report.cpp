#include "viewer/widget_report.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace ramify {

void WidgetReport::add(std::string_view name) {
  if (!is_on_ || !ImGui::IsItemVisible()) return;
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  add(name, low.x, low.y, high.x, high.y);
}

void WidgetReport::add(std::string_view name, float x0, float y0, float x1, float y1) {
  if (!is_on_) return;
  std::string word(name);
  std::replace(word.begin(), word.end(), ' ', '_');
  next_[word] = fmt::format("{:.0f} {:.0f} {:.0f} {:.0f}", x0, y0, x1, y1);
}

void WidgetReport::flush() {
  if (!is_on_) return;
  for (const auto& [name, place] : next_) {
    const auto before = shown_.find(name);
    if (before == shown_.end() || before->second != place) fmt::print("RECT {} {}\n", name, place);
  }
  for (const auto& [name, place] : shown_) {
    if (next_.find(name) == next_.end()) fmt::print("GONE {}\n", name);
  }
  std::fflush(stdout);
  shown_ = std::exchange(next_, {});
}

void WidgetReport::say(const std::string& line) const {
  if (!is_on_) return;
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

}  // namespace ramify
