#include "common/config/inheritance.h"

#include <algorithm>

namespace ramify {
namespace {

std::string joined(const std::string& prefix, const std::string& key) {
  return prefix.empty() ? key : prefix + "." + key;
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
    const auto same = std::find_if(owner_table.begin(), owner_table.end(), [&](const FieldRow& candidate) {
      return candidate.key == row.key && candidate.kind == row.kind;
    });
    if (same == owner_table.end()) continue;
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

}  // namespace

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
