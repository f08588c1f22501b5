#include "viewer/panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>

#include "common/config/toml_writer.h"

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

/// An owner as it is, as it was opened and by default; the last two are null where they have no such item.
struct Owners {
  void* now = nullptr;
  void* opened = nullptr;
  void* by_default = nullptr;
};

/// The items of lists and maps, named as in keys.
struct Item {
  std::string name;
  Owners owners;
};

Owners members(const FieldRow& row, const Owners& owners) {
  const auto member = [&](void* owner) { return owner == nullptr ? nullptr : row.member(owner); };
  return {member(owners.now), member(owners.opened), member(owners.by_default)};
}

std::vector<Item> list_items(const FieldRow& row, const Owners& lists) {
  std::vector<Item> items;
  const std::size_t count = row.size(lists.now);
  if (lists.by_default != nullptr) {
    // Before addresses of items are taken: they move as the list grows.
    while (row.size(lists.by_default) < count) row.append(lists.by_default);
  }
  for (std::size_t index = 0; index < count; ++index) {
    Item item{std::to_string(index + 1), {row.item(lists.now, index), nullptr, nullptr}};
    if (lists.opened != nullptr && index < row.size(lists.opened)) {
      item.owners.opened = row.item(lists.opened, index);
    }
    if (lists.by_default != nullptr) item.owners.by_default = row.item(lists.by_default, index);
    items.push_back(std::move(item));
  }
  return items;
}

std::vector<Item> map_items(const FieldRow& row, const Owners& maps) {
  std::vector<Item> items;
  std::vector<std::string> known;
  if (maps.opened != nullptr) known = row.names(maps.opened);
  for (const std::string& name : row.names(maps.now)) {
    Item item{name, {row.named(maps.now, name), nullptr, nullptr}};
    if (std::find(known.begin(), known.end(), name) != known.end()) {
      item.owners.opened = row.named(maps.opened, name);
    }
    if (maps.by_default != nullptr) item.owners.by_default = row.named(maps.by_default, name);
    items.push_back(std::move(item));
  }
  return items;
}

std::vector<Item> items_of(const FieldRow& row, const Owners& owners) {
  return row.kind == FieldKind::list ? list_items(row, owners) : map_items(row, owners);
}

class Rows {
 public:
  Rows(Panel& panel, WidgetReport& report) : panel_(panel), report_(report) {}

  WidgetOutcome table(const Table& table, const Owners& owners, const std::string& prefix);

 private:
  WidgetOutcome scalars(const Table& table, const Owners& owners, const std::string& prefix);
  WidgetOutcome scalar(const FieldRow& row, const Owners& members, const std::string& key);
  WidgetOutcome nested(const FieldRow& row, const Owners& members, const std::string& key);
  WidgetOutcome branch(const std::string& label, const std::string& key, const FieldRow& row,
                       const Owners& owners);
  WidgetOutcome menu(const FieldRow& row, const Owners& members);
  void explain(const FieldRow& row, const Owners& members, const std::string& key) const;
  bool is_shown(const FieldRow& row, const std::string& key) const;
  bool has_shown(const FieldRow& row, const Owners& members, const std::string& key) const;

  Panel& panel_;
  WidgetReport& report_;
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
      return is_nested(inner) ? has_shown(inner, ramify::members(inner, owners), inner_key)
                              : is_shown(inner, inner_key);
    });
  };
  if (row.kind == FieldKind::group) return in_table(members, key + ".");
  const std::vector<Item> items = items_of(row, members);
  return std::any_of(items.begin(), items.end(),
                     [&](const Item& item) { return in_table(item.owners, key + "." + item.name + "."); });
}

WidgetOutcome Rows::table(const Table& table, const Owners& owners, const std::string& prefix) {
  WidgetOutcome outcome = scalars(table, owners, prefix);
  for (const FieldRow& row : table) {
    if (is_nested(row)) outcome |= nested(row, members(row, owners), prefix + row.key);
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
    outcome |= scalar(row, members(row, owners), key);
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
    report_.add(key, before.x, before.y, before.x + width, before.y + ImGui::GetFrameHeight());
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

WidgetOutcome Rows::nested(const FieldRow& row, const Owners& members, const std::string& key) {
  if (!has_shown(row, members, key)) return {};
  if (row.kind == FieldKind::group) return branch(row.key, key, row, members);
  const std::vector<Item> items = items_of(row, members);
  WidgetOutcome outcome;
  for (const Item& item : items) {
    const bool has_any = panel_.filter.empty() || has_shown(row, members, key);
    if (has_any) outcome |= branch(row.key + " " + item.name, key + "." + item.name, row, item.owners);
  }
  return outcome;
}

/// A part of the tree of tables that can be folded; open from the start if it is near the top.
WidgetOutcome Rows::branch(const std::string& label, const std::string& key, const FieldRow& row,
                           const Owners& owners) {
  const bool is_top = key.find('.') == std::string::npos;
  if (!panel_.filter.empty()) ImGui::SetNextItemOpen(true);
  const ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_Framed | ImGuiTreeNodeFlags_SpanAvailWidth |
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
