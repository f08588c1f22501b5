#include "viewer/show_view.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

#include "common/mesh/attribute_colors.h"
#include "common/mesh/palette.h"
#include "viewer/actions.h"
#include "viewer/marks.h"
#include "viewer/theme.h"

namespace ramify {
namespace {

void heading(const char* text) {
  ImGui::Spacing();
  ImGui::TextDisabled("%s", text);
  ImGui::Separator();
}

void choose_style(Workbench& bench) {
  constexpr std::array<std::pair<const char*, RenderStyle>, 3> kStyles = {
      {{"lit", RenderStyle::lit},
       {"schematic", RenderStyle::schematic},
       {"skeleton", RenderStyle::skeleton}}};
  for (const auto& [name, style] : kStyles) {
    if (name != kStyles.front().first) ImGui::SameLine();
    if (ImGui::RadioButton(name, bench.show.style == style)) bench.show.style = style;
    bench.report.add(std::string("style.") + name);
  }
}

/// Attributes that any of the trees has.
std::vector<std::string> attributes_of(const Workbench& bench) {
  std::vector<std::string> names;
  for (const auto& seat : bench.seats) {
    const Product* product = seat->document.product();
    if (product == nullptr || product->skeleton.node_count() == 0) continue;
    for (const std::string& name : color_attributes(product->skeleton)) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

void choose_colors(Workbench& bench) {
  ImGui::SetNextItemWidth(-1.0f);
  const char* chosen = bench.show.color_by.empty() ? "what it is made of" : bench.show.color_by.c_str();
  const bool is_open = ImGui::BeginCombo("##color", chosen);
  bench.report.add("color");
  if (!is_open) return;
  if (ImGui::Selectable("what it is made of", bench.show.color_by.empty())) bench.show.color_by.clear();
  bench.report.add("color.none");
  for (const std::string& name : attributes_of(bench)) {
    if (ImGui::Selectable(name.c_str(), bench.show.color_by == name)) bench.show.color_by = name;
    bench.report.add("color." + name);
  }
  ImGui::EndCombo();
}

void legend_text(ImDrawList& list, const ImVec2& at, const std::string& text) {
  list.AddText(at, IM_COL32(228, 228, 230, 255), text.c_str());
}

ImU32 packed(const Color& color) {
  return ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, 1.0f});
}

/// A square and the value for each, beginning at the upper left corner.
void legend_entries(ImDrawList& list, const AttributeScale& scale, const ImVec2& low, float width) {
  constexpr int kMost = 9;
  const float unit = ui_scale();
  const int count = std::min(kMost, static_cast<int>(scale.high - scale.low) + 1);
  for (int entry = 0; entry < count; ++entry) {
    const auto value = static_cast<std::size_t>(scale.low) + static_cast<std::size_t>(entry);
    const float x = low.x + width / kMost * static_cast<float>(entry);
    list.AddRectFilled({x, low.y + 3.0f * unit}, {x + 8.0f * unit, low.y + 11.0f * unit},
                       packed(categorical_color(value)));
    legend_text(list, {x + 10.0f * unit, low.y - 1.0f * unit}, std::to_string(value));
  }
}

/// All colours in a row between the least and the greatest value, as far as `right`.
void legend_ramp(ImDrawList& list, const AttributeScale& scale, const ImVec2& low, float right) {
  const float unit = ui_scale();
  const std::string from = fmt::format("{:.3g}", scale.low);
  const std::string to = fmt::format("{:.3g}", scale.high);
  const float start = low.x + 6.0f * unit + ImGui::CalcTextSize(from.c_str()).x;
  const float end = right - 6.0f * unit - ImGui::CalcTextSize(to.c_str()).x;
  legend_text(list, low, from);
  legend_text(list, {end + 6.0f * unit, low.y}, to);
  constexpr int kPieces = 48;
  for (int piece = 0; piece < kPieces; ++piece) {
    const float x = start + (end - start) * static_cast<float>(piece) / kPieces;
    list.AddRectFilled({x, low.y + 3.0f * unit},
                       {x + (end - start) / kPieces + 1.0f, low.y + ImGui::GetTextLineHeight() - 2.0f * unit},
                       packed(sequential_color((piece + 0.5) / kPieces)));
  }
}

}  // namespace

std::vector<std::string> overlays_of(const Workbench& bench) {
  std::vector<std::string> names;
  for (const auto& seat : bench.seats) {
    if (!seat->document.has_job()) continue;
    for (const std::string& name : overlay_names(seat->document.job())) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

void switch_overlay(Workbench& bench, const std::string& name) {
  if (bench.show.layers.erase(name) == 0) bench.show.layers.insert(name);
  update_layers(bench);
}

void show_choices(Workbench& bench) {
  ImGui::BeginChild("choices");
  heading("Style");
  choose_style(bench);
  heading("Colour by");
  choose_colors(bench);
  heading("Over the tree");
  int number = 2;
  for (const std::string& name : overlays_of(bench)) {
    bool is_on = bench.show.layers.count(name) > 0;
    if (ImGui::Checkbox(name.c_str(), &is_on)) switch_overlay(bench, name);
    bench.report.add("overlay." + name);
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize("F12").x);
    ImGui::TextDisabled("F%d", number++);
  }
  ImGui::Checkbox("fields as a slice", &bench.show.are_slices);
  bench.report.add("slices");
  heading("Scale");
  if (ImGui::Checkbox("bar and a person 1.75 m tall", &bench.show.with_scale)) frame_trees(bench);
  bench.report.add("scale");
  if (bench.seats.size() > 1) {
    if (ImGui::Checkbox("same scale for both trees", &bench.is_same_scale)) frame_trees(bench);
    bench.report.add("same_scale");
  }
  ImGui::EndChild();
}

void show_legend(const Workbench& bench, std::size_t index, float right, float bottom) {
  const Product* product = bench.seats[index]->document.product();
  std::string name = bench.show.color_by;
  if (name.empty() && bench.show.style == RenderStyle::skeleton) name = "order";
  if (name.empty() || product == nullptr || bench.show.arrangement == Arrangement::overlaid) return;
  const std::vector<std::string> known = color_attributes(product->skeleton);
  if (std::find(known.begin(), known.end(), name) == known.end()) return;
  const AttributeScale scale = attribute_scale(product->skeleton, name);
  const float unit = ui_scale();
  const float line = ImGui::GetTextLineHeight();
  const float width = 14.0f * line;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 low(right - width - 20.0f * unit, bottom - 2.0f * line - 26.0f * unit);
  list.AddRectFilled(low, {right - 6.0f * unit, bottom - 6.0f * unit}, IM_COL32(24, 24, 25, 200),
                     3.0f * unit);
  const float x = low.x + 8.0f * unit;
  legend_text(list, {x, low.y + 5.0f * unit}, name + (scale.is_logarithmic ? " (logarithmic)" : ""));
  const float y = low.y + line + 10.0f * unit;
  if (scale.is_categorical) {
    legend_entries(list, scale, {x, y}, width - 8.0f * unit);
  } else {
    legend_ramp(list, scale, {x, y}, right - 14.0f * unit);
  }
}

}  // namespace ramify
