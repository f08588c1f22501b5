#include "viewer/field_widget.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "common/base/errors.h"
#include "common/config/toml_reader.h"
#include "common/config/toml_writer.h"
#include "viewer/schedule_editor.h"
#include "viewer/slider_range.h"

namespace ramify {
namespace {

WidgetOutcome outcome(bool is_changed) {
  return {is_changed, ImGui::IsItemDeactivatedAfterEdit()};
}

WidgetOutcome at_once(bool is_changed) {
  return {is_changed, is_changed};
}

double allowed(const FieldInfo& info, double value) {
  const double least = info.is_above_min ? info.min + 1e-9 * (info.max - info.min) : info.min;
  return std::clamp(value, least, info.max);
}

/// "%.4g" with the unit behind it; % would start a conversion.
std::string number_format(const FieldInfo& info) {
  std::string format = "%.4g" + short_unit(info);
  return format;
}

WidgetOutcome number_slider(const FieldRow& row, double& value, double reference) {
  const SliderRange range = slider_range(row.info, value, reference);
  const bool is_changed = ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &range.low,
                                              &range.high, number_format(row.info).c_str());
  if (is_changed) value = allowed(row.info, value);
  return outcome(is_changed);
}

WidgetOutcome integer_slider(const FieldRow& row, int& value, int reference) {
  const SliderRange range = slider_range(row.info, value, reference);
  const std::string format = "%d" + short_unit(row.info);
  // A count of 0 may become some.
  const double high = std::max(range.high, std::min(row.info.max, 10.0));
  const bool is_changed = ImGui::SliderInt("##value", &value, static_cast<int>(range.low),
                                           static_cast<int>(std::max(high, range.low + 1.0)), format.c_str());
  if (is_changed) value = static_cast<int>(allowed(row.info, value));
  return outcome(is_changed);
}

WidgetOutcome seed_input(std::uint64_t& seed) {
  // TOML's whole numbers end here.
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  const float next_width = ImGui::CalcTextSize("next").x + 2.0f * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - next_width - ImGui::GetStyle().ItemSpacing.x);
  const bool is_typed = ImGui::InputScalar("##value", ImGuiDataType_U64, &seed);
  if (is_typed) seed = std::min(seed, kMost);
  WidgetOutcome result = outcome(is_typed);
  ImGui::SameLine();
  const bool is_next = ImGui::Button("next");
  if (is_next) seed = seed < kMost ? seed + 1 : 0;
  result |= at_once(is_next);
  return result;
}

WidgetOutcome choice_list(const FieldRow& row, void* member) {
  const std::vector<std::string>& choices = row.info.choices;
  const int chosen = row.choice(member);
  bool is_changed = false;
  if (ImGui::BeginCombo("##value", choices.at(static_cast<std::size_t>(chosen)).c_str())) {
    for (int index = 0; index < static_cast<int>(choices.size()); ++index) {
      if (ImGui::Selectable(choices[index].c_str(), index == chosen) && index != chosen) {
        row.choose(member, index);
        is_changed = true;
      }
    }
    ImGui::EndCombo();
  }
  return at_once(is_changed);
}

WidgetOutcome vector_input(const FieldRow& row, Vec3& value) {
  const double greatest = std::max({std::abs(value.x), std::abs(value.y), std::abs(value.z), 1.0});
  const bool is_changed =
      ImGui::DragScalarN("##value", ImGuiDataType_Double, &value.x, 3, static_cast<float>(0.01 * greatest),
                         &row.info.min, &row.info.max, "%.3g");
  if (is_changed) {
    for (int axis = 0; axis < 3; ++axis) value[axis] = allowed(row.info, value[axis]);
  }
  return outcome(is_changed);
}

WidgetOutcome schedule_input(const FieldRow& row, Schedule& schedule, const Schedule* reference,
                             double last) {
  const double at_start = schedule.points().front().second;
  const double before = reference == nullptr ? at_start : reference->points().front().second;
  if (!schedule.is_constant()) {
    double greatest = 0.0;
    for (const auto& [step, value] : schedule.points()) {
      if (std::abs(value) > std::abs(greatest)) greatest = value;
    }
    return schedule_curve("##curve", schedule, last, slider_range(row.info, greatest, before));
  }
  const float button = ImGui::GetFrameHeight();
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemInnerSpacing.x);
  double constant = at_start;
  WidgetOutcome result = number_slider(row, constant, before);
  if (result.is_changed) schedule = Schedule(constant);
  ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
  const bool is_curve = ImGui::Button("~", {button, 0.0f});
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Let it change with the %s", row.info.over.c_str());
  if (is_curve) {
    schedule = Schedule({{row.info.over == "step" ? 1.0 : 0.0, constant}, {last, constant}});
    result |= {true, true};
  }
  return result;
}

/// Anything else, written as in a config; taken over with Enter if it can be read.
/// As people type it: names of files and texts without TOML's quotes.
std::string plain_text(const FieldRow& row, void* member) {
  if (row.kind == FieldKind::path) return static_cast<const std::filesystem::path*>(member)->string();
  if (row.kind == FieldKind::text) return *static_cast<const std::string*>(member);
  return toml_value(row, member);
}

WidgetOutcome text_input(const FieldRow& row, void* member) {
  std::array<char, 2048> text{};
  const std::string now = plain_text(row, member);
  std::strncpy(text.data(), now.c_str(), text.size() - 1);
  if (!ImGui::InputText("##value", text.data(), text.size(), ImGuiInputTextFlags_EnterReturnsTrue)) return {};
  if (row.kind == FieldKind::path) {
    *static_cast<std::filesystem::path*>(member) = text.data();
    return at_once(true);
  }
  if (row.kind == FieldKind::text) {
    *static_cast<std::string*>(member) = text.data();
    return at_once(true);
  }
  // The row as a table of its own, whose owner is the member itself.
  FieldRow itself = row;
  itself.member = [](void* owner) { return owner; };
  Origins origins;
  try {
    assign({itself}, member, row.key, text.data(), "", origins);
  } catch (const ConfigError&) {
    return {};  // what is no value leaves it as it was
  }
  return at_once(true);
}

}  // namespace

std::string short_unit(const FieldInfo& info) {
  if (info.unit == "degrees") return "\u00b0";
  if (info.unit == "metres") return " m";
  return {};
}

WidgetOutcome field_widget(const FieldRow& row, void* member, const void* reference, double last) {
  ImGui::SetNextItemWidth(-1.0f);
  switch (row.kind) {
    case FieldKind::number: {
      auto& value = *static_cast<double*>(member);
      return number_slider(row, value, reference ? *static_cast<const double*>(reference) : value);
    }
    case FieldKind::integer: {
      auto& value = *static_cast<int*>(member);
      return integer_slider(row, value, reference ? *static_cast<const int*>(reference) : value);
    }
    case FieldKind::seed:
      return seed_input(*static_cast<std::uint64_t*>(member));
    case FieldKind::boolean:
      return at_once(ImGui::Checkbox("##value", static_cast<bool*>(member)));
    case FieldKind::choice:
      return choice_list(row, member);
    case FieldKind::vector:
      return vector_input(row, *static_cast<Vec3*>(member));
    case FieldKind::schedule:
      return schedule_input(row, *static_cast<Schedule*>(member), static_cast<const Schedule*>(reference),
                            last);
    case FieldKind::sketch:
    case FieldKind::text:
    case FieldKind::path:
      return text_input(row, member);
    case FieldKind::group:
    case FieldKind::list:
    case FieldKind::map:
      break;
  }
  return {};
}

}  // namespace ramify
