#include "common/config/inheritance.h"

#include <algorithm>

#include "common/config/toml_writer.h"

namespace ramify {
namespace {

std::string joined(const std::string& prefix, const std::string& key) {
  return prefix.empty() ? key : prefix + "." + key;
}

/// The row of an owner's table that `row`, of an item's, inherits from; nullptr if there is none.
const FieldRow* same_row(const FieldRow& row, const Table& owner_table) {
  const auto same = std::find_if(owner_table.begin(), owner_table.end(), [&](const FieldRow& candidate) {
    return candidate.key == row.key && candidate.kind == row.kind;
  });
  return same == owner_table.end() ? nullptr : &*same;
}

void inherit_rows(const Table& table, void* item, const Table& owner_table, void* owner,
                  const std::string& path, const Origins& origins);

void inherit_named(const FieldRow& row, void* map, void* owner_map, const std::string& path,
                   const Origins& origins) {
  const Table& child = row.child();
  for (const std::string& name : row.names(owner_map)) {
    inherit_rows(child, row.named(map, name), child, row.named(owner_map, name), joined(path, name), origins);
  }
}

void inherit_rows(const Table& table, void* item, const Table& owner_table, void* owner,
                  const std::string& path, const Origins& origins) {
  for (const FieldRow& row : table) {
    const FieldRow* const same = same_row(row, owner_table);
    if (same == nullptr) continue;
    const std::string key = joined(path, row.key);
    void* const member = row.member(item);
    void* const owner_member = same->member(owner);
    const auto first = origins.lower_bound(key);
    const bool is_set = first != origins.end() && first->first.compare(0, key.size(), key) == 0 &&
                        (first->first.size() == key.size() || first->first[key.size()] == '.');
    if (!is_set) {
      row.copy(member, owner_member);
    } else if (row.kind == FieldKind::group) {
      inherit_rows(row.child(), member, row.child(), owner_member, key, origins);
    } else if (row.kind == FieldKind::map) {
      inherit_named(row, member, owner_member, key, origins);
    }
  }
}

void follow_rows(const Table& table, void* item, const Table& owner_table, void* before, void* owner);

/// Names that the owner gained or lost are gained and lost.
void follow_named(const FieldRow& row, void* map, void* before, void* owner) {
  const auto has = [&](void* names, const std::string& name) {
    const std::vector<std::string> all = row.names(names);
    return std::find(all.begin(), all.end(), name) != all.end();
  };
  for (const std::string& name : row.names(owner)) {
    if (!has(before, name)) {
      inherit_rows(row.child(), row.named(map, name), row.child(), row.named(owner, name), {}, {});
    } else if (has(map, name)) {
      follow_rows(row.child(), row.named(map, name), row.child(), row.named(before, name),
                  row.named(owner, name));
    }
  }
  for (const std::string& name : row.names(before)) {
    if (!has(owner, name)) row.remove_named(map, name);
  }
}

void follow_rows(const Table& table, void* item, const Table& owner_table, void* before, void* owner) {
  for (const FieldRow& row : table) {
    const FieldRow* const same = same_row(row, owner_table);
    if (same == nullptr || row.kind == FieldKind::list) continue;
    void* const member = row.member(item);
    void* const old_member = same->member(before);
    void* const owner_member = same->member(owner);
    if (row.kind == FieldKind::group) {
      follow_rows(row.child(), member, row.child(), old_member, owner_member);
    } else if (row.kind == FieldKind::map) {
      follow_named(row, member, old_member, owner_member);
    } else if (toml_value(row, member) == toml_value(row, old_member)) {
      row.copy(member, owner_member);
    }
  }
}

}  // namespace

void* append_item(const Table& table, void* owner, const FieldRow& row) {
  void* const item = row.append(row.member(owner));
  if (row.info.inherits_owner) inherit_rows(row.child(), item, table, owner, {}, {});
  return item;
}

void follow_owner(const Table& table, void* before, void* owner) {
  for (const FieldRow& row : table) {
    if (row.kind == FieldKind::group) follow_owner(row.child(), row.member(before), row.member(owner));
    if (row.kind != FieldKind::list || !row.info.inherits_owner) continue;
    void* const list = row.member(owner);
    for (std::size_t i = 0; i < row.size(list); ++i) {
      follow_rows(row.child(), row.item(list, i), table, before, owner);
    }
  }
}

void inherit_from_owners(const Table& table, void* owner, const std::string& prefix, const Origins& origins) {
  for (const FieldRow& row : table) {
    void* const member = row.member(owner);
    const std::string key = joined(prefix, row.key);
    if (row.kind == FieldKind::group) inherit_from_owners(row.child(), member, key, origins);
    if (row.kind != FieldKind::list || !row.info.inherits_owner) continue;
    for (std::size_t i = 0; i < row.size(member); ++i) {
      inherit_rows(row.child(), row.item(member, i), table, owner, joined(key, std::to_string(i + 1)),
                   origins);
    }
  }
}

}  // namespace ramify
