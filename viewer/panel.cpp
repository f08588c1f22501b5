#include "viewer/panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "common/config/inheritance.h"
#include "common/config/toml_writer.h"
#include "viewer/panel_items.h"

namespace ramify {
namespace {

bool is_nested(const FieldRow& row) {
  return row.kind == FieldKind::group || row.kind == FieldKind::list || row.kind == FieldKind::map;
}

bool contains_word(const std::string& text, const std::string& word) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  };
  return std::search(text.begin(), text.end(), word.begin(), word.end(), same) != text.end();
}

class Rows {
 public:
  Rows(Panel& panel, WidgetReport& report) : panel_(panel), report_(report) {}

  WidgetOutcome table(const Table& table, const Owners& owners, const std::string& prefix);

 private:
  WidgetOutcome scalars(const Table& table, const Owners& owners, const std::string& prefix);
  WidgetOutcome scalar(const FieldRow& row, const Owners& members, const std::string& key);
  WidgetOutcome nested(const Table& table, const FieldRow& row, const Owners& owners, const std::string& key);
  WidgetOutcome heading(const Table& table, const FieldRow& row, void* owner, const std::string& key);
  bool name_input(const FieldRow& row, void* map, const std::string& key);
  WidgetOutcome branch(const std::string& label, const std::string& key, const FieldRow& row,
                       const Owners& owners);
  bool remove_button(const std::string& key, float top);
  WidgetOutcome menu(const FieldRow& row, const Owners& members);
  void explain(const FieldRow& row, const Owners& members, const std::string& key) const;
  bool is_shown(const FieldRow& row, const std::string& key) const;
  bool has_shown(const FieldRow& row, const Owners& members, const std::string& key) const;

  Panel& panel_;
  WidgetReport& report_;
  std::string& fresh_ = panel_.fresh;
};

bool Rows::is_shown(const FieldRow& row, const std::string& key) const {
  return panel_.filter.empty() || contains_word(key, panel_.filter) ||
         contains_word(row.info.help, panel_.filter);
}

/// Whether a group, list or map has anything to show.
bool Rows::has_shown(const FieldRow& row, const Owners& members, const std::string& key) const {
  if (panel_.filter.empty()) return true;
  const auto in_table = [&](const Owners& owners, const std::string& prefix) {
    return std::any_of(row.child().begin(), row.child().end(), [&](const FieldRow& inner) {
      const std::string inner_key = prefix + inner.key;
      return is_nested(inner) ? has_shown(inner, members_of(inner, owners), inner_key)
                              : is_shown(inner, inner_key);
    });
  };
  if (row.kind == FieldKind::group) return in_table(members, key + ".");
  if (is_shown(row, key)) return true;
  const std::vector<PanelItem> items = items_of(row, members);
  return std::any_of(items.begin(), items.end(), [&](const PanelItem& item) {
    return in_table(item.owners, key + "." + item.name + ".");
  });
}

WidgetOutcome Rows::table(const Table& table, const Owners& owners, const std::string& prefix) {
  WidgetOutcome outcome = scalars(table, owners, prefix);
  for (const FieldRow& row : table) {
    if (is_nested(row)) outcome |= nested(table, row, owners, prefix + row.key);
  }
  return outcome;
}

WidgetOutcome Rows::scalars(const Table& table, const Owners& owners, const std::string& prefix) {
  WidgetOutcome outcome;
  const bool has_any = std::any_of(table.begin(), table.end(), [&](const FieldRow& row) {
    return !is_nested(row) && is_shown(row, prefix + row.key);
  });
  if (!has_any || !ImGui::BeginTable("rows", 3)) return outcome;
  const float mark = ImGui::GetFrameHeight();
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.44f);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.56f);
  ImGui::TableSetupColumn("mark", ImGuiTableColumnFlags_WidthFixed, mark);
  for (const FieldRow& row : table) {
    const std::string key = prefix + row.key;
    if (is_nested(row) || !is_shown(row, key)) continue;
    ImGui::TableNextRow();
    ImGui::PushID(row.key.c_str());
    outcome |= scalar(row, members_of(row, owners), key);
    ImGui::PopID();
  }
  ImGui::EndTable();
  return outcome;
}

WidgetOutcome Rows::scalar(const FieldRow& row, const Owners& members, const std::string& key) {
  const bool is_changed =
      members.opened != nullptr && toml_value(row, members.now) != toml_value(row, members.opened);
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  if (is_changed) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_CheckMark));
  ImGui::TextUnformatted(row.key.c_str());
  if (is_changed) ImGui::PopStyleColor();
  if (ImGui::IsItemHovered()) explain(row, members, key);
  WidgetOutcome outcome = menu(row, members);

  ImGui::TableNextColumn();
  const ImVec2 before = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  outcome |= field_widget(row, members.now, members.opened, panel_.last_step);
  if (ImGui::IsItemVisible()) {
    report_.add(key, before.x, before.y, before.x + width, ImGui::GetItemRectMax().y);
  }

  ImGui::TableNextColumn();
  if (!is_changed) return outcome;
  if (ImGui::Button("<", {-1.0f, 0.0f})) {
    row.copy(members.now, members.opened);
    outcome |= {true, true};
  }
  report_.add(key + ".reset");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Back to %s", toml_value(row, members.opened).c_str());
  return outcome;
}

WidgetOutcome Rows::menu(const FieldRow& row, const Owners& members) {
  WidgetOutcome outcome;
  if (!ImGui::BeginPopupContextItem("menu")) return outcome;
  const auto offer = [&](const char* what, const void* member) {
    const std::string text = fmt::format("{}: {}", what, toml_value(row, member));
    if (!ImGui::MenuItem(text.c_str())) return;
    row.copy(members.now, member);
    outcome = {true, true};
  };
  if (members.by_default != nullptr) offer("Default", members.by_default);
  if (members.opened != nullptr) offer("As opened", members.opened);
  ImGui::EndPopup();
  return outcome;
}

void Rows::explain(const FieldRow& row, const Owners& members, const std::string& key) const {
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24.0f);
  ImGui::TextUnformatted(key.c_str());
  ImGui::TextUnformatted(row.info.help.c_str());
  std::string range = allowed_values(row);
  if (!row.info.unit.empty()) range += ", in " + row.info.unit;
  ImGui::TextDisabled("%s", range.c_str());
  if (members.by_default != nullptr) {
    ImGui::TextDisabled("default %s", toml_value(row, members.by_default).c_str());
  }
  if (!row.info.source.empty()) ImGui::TextDisabled("%s", row.info.source.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

WidgetOutcome Rows::nested(const Table& table, const FieldRow& row, const Owners& owners,
                           const std::string& key) {
  const Owners members = members_of(row, owners);
  if (!has_shown(row, members, key)) return {};
  if (row.kind == FieldKind::group) return branch(row.key, key, row, members);
  WidgetOutcome outcome;
  if (is_shown(row, key)) outcome = heading(table, row, owners.now, key);
  std::optional<PanelItem> unwanted;
  for (const PanelItem& item : items_of(row, members)) {
    const float top = ImGui::GetCursorScreenPos().y;
    const std::string item_key = key + "." + item.name;
    if (fresh_ == item_key) ImGui::SetNextItemOpen(true);
    outcome |= branch(row.key + " " + item.name, item_key, row, item.owners);
    if (remove_button(item_key, top)) unwanted = item;
  }
  if (!unwanted) return outcome;
  remove_item(row, members.now, *unwanted);
  return {true, true};
}

/// What a list or map is called, and the button that adds to it.
WidgetOutcome Rows::heading(const Table& table, const FieldRow& row, void* owner, const std::string& key) {
  void* const member = row.member(owner);
  ImGui::PushID(key.c_str());
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", row.key.c_str());
  if (ImGui::IsItemHovered() && !row.info.help.empty()) ImGui::SetTooltip("%s", row.info.help.c_str());
  const float size = ImGui::GetFrameHeight();
  bool is_added = false;
  if (row.kind == FieldKind::map) {
    is_added = name_input(row, member, key);
  } else {
    ImGui::SameLine(ImGui::GetContentRegionMax().x - size);
    is_added = ImGui::Button("+", {size, 0.0f});
    report_.add(key + ".add");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Add one");
    if (is_added) append_item(table, owner, row);
    if (is_added) fresh_ = key + "." + std::to_string(row.size(member));
  }
  ImGui::PopID();
  return {is_added, is_added};
}

/// A new item's name, taken with Enter.
bool Rows::name_input(const FieldRow& row, void* map, const std::string& key) {
  const float width = 9.0f * ImGui::GetFontSize();
  ImGui::SameLine(ImGui::GetContentRegionMax().x - width);
  ImGui::SetNextItemWidth(width);
  std::array<char, 64> name{};
  const bool is_entered = ImGui::InputTextWithHint("##name", "+ name", name.data(), name.size(),
                                                   ImGuiInputTextFlags_EnterReturnsTrue);
  report_.add(key + ".add");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Add one: its name and Enter");
  if (!is_entered || !is_free_name(row, map, name.data())) return false;
  row.named(map, name.data());
  fresh_ = key + "." + name.data();
  return true;
}

/// Over the right end of an item's line, which begins at `top`.
bool Rows::remove_button(const std::string& key, float top) {
  const ImVec2 after = ImGui::GetCursorScreenPos();
  const float size = ImGui::GetFrameHeight();
  ImGui::SetCursorScreenPos({ImGui::GetWindowPos().x + ImGui::GetContentRegionMax().x - size, top});
  ImGui::PushID(key.c_str());
  const bool is_pressed = ImGui::Button("x", {size, 0.0f});
  ImGui::PopID();
  report_.add(key + ".remove");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Take it away");
  ImGui::SetCursorScreenPos(after);
  return is_pressed;
}

/// A part of the tree of tables that can be folded; open from the start if it is near the top.
WidgetOutcome Rows::branch(const std::string& label, const std::string& key, const FieldRow& row,
                           const Owners& owners) {
  const bool is_top = key.find('.') == std::string::npos;
  if (!panel_.filter.empty()) ImGui::SetNextItemOpen(true);
  const ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_Framed | ImGuiTreeNodeFlags_SpanAvailWidth |
                                   ImGuiTreeNodeFlags_AllowItemOverlap |
                                   (is_top ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None);
  const bool is_open = ImGui::TreeNodeEx(key.c_str(), flags, "%s", label.c_str());
  report_.add(key);
  if (ImGui::IsItemHovered() && !row.info.help.empty()) ImGui::SetTooltip("%s", row.info.help.c_str());
  if (!is_open) return {};
  const WidgetOutcome outcome = table(row.child(), owners, key + ".");
  ImGui::TreePop();
  return outcome;
}

}  // namespace

WidgetOutcome parameter_rows(const Table& table, Job& job, const Job& opened, Panel& panel,
                             WidgetReport& report) {
  // Rows hand out addresses of members; what was opened is only read through them.
  const Owners owners{&job, const_cast<Job*>(&opened), &panel.defaults};
  return Rows(panel, report).table(table, owners, "");
}

}  // namespace ramify
