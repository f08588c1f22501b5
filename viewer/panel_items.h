// The items of lists and maps as the panel shows them: what there is, and adding and taking away by hand.
#pragma once

#include <string>
#include <vector>

#include "common/config/field.h"

namespace ramify {

/// An owner as it is, as it was opened and by default; the last two are null where they have no such item.
struct Owners {
  void* now = nullptr;
  void* opened = nullptr;
  void* by_default = nullptr;
};

/// The row's members of all three.
Owners members_of(const FieldRow& row, const Owners& owners);

struct PanelItem {
  std::string name;  // as in keys
  Owners owners;
};

/// Of a list or map, by its members; the default list grows as long as the one that is shown.
std::vector<PanelItem> items_of(const FieldRow& row, const Owners& members);

/// Whether a map, `member`, may get an item of this name: one that a dotted key can say, and not there yet.
bool is_free_name(const FieldRow& row, const void* member, const std::string& name);

void remove_item(const FieldRow& row, void* member, const PanelItem& item);

}  // namespace ramify
