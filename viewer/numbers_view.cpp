#include "viewer/numbers_view.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "common/mesh/palette.h"
#include "viewer/theme.h"

namespace ramify {
namespace {

/// Empty if the metric has no such value.
std::string text_of(const MetricInfo& info, const std::optional<double>& value) {
  return value ? number_text(*value, info.is_count) : "-";
}

/// 0 where only rounding tells them apart.
double difference(double from, double to) {
  return std::abs(to - from) <= 1e-12 * std::max(std::abs(from), std::abs(to)) ? 0.0 : to - from;
}

void right_aligned(const std::string& text) {
  const float free = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0f, free));
  ImGui::TextUnformatted(text.c_str());
}

const Numbers* numbers_of_seat(const Workbench& bench, std::size_t index) {
  const Product* product = bench.seats[index]->document.product();
  return product != nullptr ? product->numbers.get() : nullptr;
}

/// What a metric is, and all its digits.
void explain(const MetricInfo& info, const std::vector<std::optional<double>>& values) {
  std::string text = fmt::format("{}\n{}{}", info.key, info.help,
                                 info.unit.empty() ? "" : fmt::format(", in {}", info.unit));
  if (!info.reference.empty()) text += fmt::format("\nreal trees: {}", info.reference);
  for (std::size_t index = 0; index < values.size(); ++index) {
    if (values[index]) text += fmt::format("\n{}  {:.10g}", seat_name(index), *values[index]);
  }
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyle().Colors[ImGuiCol_Text]);
  ImGui::SetTooltip("%s", text.c_str());
  ImGui::PopStyleColor();
}

/// A metric of each tree, and what tells them apart.
struct MetricRow {
  const MetricInfo* info;
  std::vector<std::optional<double>> values;
  std::vector<std::string> texts;
};

std::vector<MetricRow> rows_of(const Workbench& bench) {
  std::vector<MetricRow> rows;
  for (const MetricInfo& info : metric_table()) {
    MetricRow& row = rows.emplace_back();
    row.info = &info;
    for (std::size_t index = 0; index < bench.seats.size(); ++index) {
      const Numbers* numbers = numbers_of_seat(bench, index);
      row.values.push_back(numbers == nullptr ? std::nullopt : info.value(numbers->metrics));
      row.texts.push_back(text_of(info, row.values.back()));
    }
    if (row.values.size() < 2) continue;
    const std::optional<double>& a = row.values[0];
    const std::optional<double>& b = row.values[1];
    row.texts.push_back(a && b ? number_text(difference(*a, *b), info.is_count, true) : "-");
  }
  return rows;
}

void metric_row(const MetricRow& row) {
  const std::string_view name = row.info->key;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(name.data(), name.data() + name.size());
  if (ImGui::IsItemHovered()) explain(*row.info, row.values);
  for (const std::string& text : row.texts) {
    ImGui::TableNextColumn();
    right_aligned(text);
    if (ImGui::IsItemHovered()) explain(*row.info, row.values);
  }
}

/// Numbers get as much room as the widest of them takes, and names the rest.
void metric_rows(Workbench& bench) {
  const std::vector<MetricRow> rows = rows_of(bench);
  std::vector<std::string> titles;
  for (std::size_t index = 0; index < bench.seats.size(); ++index) titles.push_back(seat_name(index));
  if (titles.size() > 1) titles.emplace_back("B - A");
  if (!ImGui::BeginTable("metrics", static_cast<int>(titles.size()) + 1, ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("metric", ImGuiTableColumnFlags_WidthStretch);
  for (std::size_t column = 0; column < titles.size(); ++column) {
    float width = ImGui::CalcTextSize(titles[column].c_str()).x;
    for (const MetricRow& row : rows) {
      width = std::max(width, ImGui::CalcTextSize(row.texts[column].c_str()).x);
    }
    ImGui::TableSetupColumn(titles[column].c_str(), ImGuiTableColumnFlags_WidthFixed, std::ceil(width));
  }
  ImGui::TableHeadersRow();
  for (const MetricRow& row : rows) metric_row(row);
  ImGui::EndTable();
}

/// Of a tree that still changes they are those of the one before.
bool are_old(const Workbench& bench) {
  return std::any_of(bench.seats.begin(), bench.seats.end(),
                     [](const auto& seat) { return !seat->document.is_settled(); });
}

void distance_rows(Workbench& bench) {
  if (bench.seats.size() < 2) return;
  const auto numbers = [&](std::size_t index) {
    const Product* product = bench.seats[index]->document.product();
    return product != nullptr ? product->numbers : nullptr;
  };
  bench.distances.follow(numbers(0), numbers(1));
  ImGui::Spacing();
  ImGui::TextUnformatted("Distances between A and B, 0 if they are alike");
  if (!ImGui::BeginTable("distances", 2, ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("distance", ImGuiTableColumnFlags_WidthStretch, 1.7f);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.8f);
  for (std::size_t k = 0; k < kDistanceCount; ++k) {
    const DistanceInfo& info = distance_table()[k];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(info.key.data(), info.key.data() + info.key.size());
    if (ImGui::IsItemHovered()) {
      ImGui::SetTooltip("%.*s", static_cast<int>(info.help.size()), info.help.data());
    }
    ImGui::TableNextColumn();
    const auto& values = bench.distances.values();
    right_aligned(values && numbers(0) && numbers(1) ? fmt::format("{:.4f}", (*values)[k]) : "-");
  }
  ImGui::EndTable();
}

/// Bars of the classes, those of the orders stacked.
void bars(const char* title, const char* unit, const Histogram& histogram) {
  ImGui::Spacing();
  ImGui::TextUnformatted(title);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, 90.0f * ui_scale());
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, {low.x + size.x, low.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg), 3.0f);
  float most = 1.0f;
  for (std::size_t index = 0; index < Histogram::kClasses; ++index) {
    float sum = 0.0f;
    for (const auto& order : histogram.by_order) sum += order[index];
    most = std::max(most, sum);
  }
  const float width = size.x / Histogram::kClasses;
  for (std::size_t index = 0; index < Histogram::kClasses; ++index) {
    float y = low.y + size.y;
    for (std::size_t order = 0; order < histogram.by_order.size(); ++order) {
      const float bar = histogram.by_order[order][index] / most * (size.y - 6.0f);
      const Color color = categorical_color(order);
      const float x = low.x + width * static_cast<float>(index);
      list.AddRectFilled({x + 1.0f, y - bar}, {x + width - 1.0f, y},
                         ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, 1.0f}));
      y -= bar;
    }
  }
  ImGui::Dummy(size);
  ImGui::TextDisabled("0");
  const std::string end = fmt::format("{:.3g} {}", histogram.high, unit);
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(end.c_str()).x);
  ImGui::TextDisabled("%s", end.c_str());
}

}  // namespace

void show_numbers(Workbench& bench) {
  ImGui::BeginChild("numbers");
  const bool is_dim = are_old(bench);
  if (is_dim) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  metric_rows(bench);
  distance_rows(bench);
  if (is_dim) ImGui::PopStyleColor();
  if (const Numbers* numbers = numbers_of_seat(bench, bench.active)) {
    const std::string of = bench.seats.size() > 1 ? " of " + seat_name(bench.active) : "";
    bars(("Branching angles" + of + ", by order").c_str(), "degrees", numbers->angles);
    bars(("Lengths of axes" + of + ", by order").c_str(), "m", numbers->lengths);
    for (std::size_t order = 0; order < numbers->angles.by_order.size(); ++order) {
      const Color color = categorical_color(order);
      const bool is_last = order + 1 == numbers->angles.by_order.size() && order > 0;
      if (order > 0) ImGui::SameLine();
      ImGui::TextColored({color.r, color.g, color.b, 1.0f}, "%zu%s", order, is_last ? " and above" : "");
    }
  }
  ImGui::EndChild();
}

}  // namespace ramify
