#include "viewer/panel_items.h"

#include <algorithm>
#include <cctype>

namespace ramify {
namespace {

bool has_name(const FieldRow& row, const void* map, const std::string& name) {
  const std::vector<std::string> names = row.names(map);
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<PanelItem> list_items(const FieldRow& row, const Owners& lists) {
  std::vector<PanelItem> items;
  const std::size_t count = row.size(lists.now);
  if (lists.by_default != nullptr) {
    // Before addresses of items are taken: they move as the list grows.
    while (row.size(lists.by_default) < count) row.append(lists.by_default);
  }
  for (std::size_t index = 0; index < count; ++index) {
    PanelItem item{std::to_string(index + 1), {row.item(lists.now, index), nullptr, nullptr}};
    if (lists.opened != nullptr && index < row.size(lists.opened)) {
      item.owners.opened = row.item(lists.opened, index);
    }
    if (lists.by_default != nullptr) item.owners.by_default = row.item(lists.by_default, index);
    items.push_back(std::move(item));
  }
  return items;
}

std::vector<PanelItem> map_items(const FieldRow& row, const Owners& maps) {
  std::vector<PanelItem> items;
  for (const std::string& name : row.names(maps.now)) {
    PanelItem item{name, {row.named(maps.now, name), nullptr, nullptr}};
    if (maps.opened != nullptr && has_name(row, maps.opened, name)) {
      item.owners.opened = row.named(maps.opened, name);
    }
    if (maps.by_default != nullptr) item.owners.by_default = row.named(maps.by_default, name);
    items.push_back(std::move(item));
  }
  return items;
}

}  // namespace

Owners members_of(const FieldRow& row, const Owners& owners) {
  const auto member = [&](void* owner) { return owner == nullptr ? nullptr : row.member(owner); };
  return {member(owners.now), member(owners.opened), member(owners.by_default)};
}

std::vector<PanelItem> items_of(const FieldRow& row, const Owners& members) {
  return row.kind == FieldKind::list ? list_items(row, members) : map_items(row, members);
}

bool is_free_name(const FieldRow& row, const void* member, const std::string& name) {
  const bool is_word = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
  return is_word && !has_name(row, member, name);
}

void remove_item(const FieldRow& row, void* member, const PanelItem& item) {
  if (row.kind == FieldKind::map) {
    row.remove_named(member, item.name);
  } else {
    row.remove(member, std::stoul(item.name) - 1);
  }
}

}  // namespace ramify
