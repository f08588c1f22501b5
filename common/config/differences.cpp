#include "common/config/differences.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "common/config/toml_writer.h"

namespace ramify {
namespace {

std::string inline_table(const Table& table, void* owner);

std::string inline_value(const FieldRow& row, void* member) {
  std::vector<std::string> parts;
  switch (row.kind) {
    case FieldKind::group:
      return inline_table(row.child(), member);
    case FieldKind::list:
      for (std::size_t index = 0; index < row.size(member); ++index) {
        parts.push_back(inline_table(row.child(), row.item(member, index)));
      }
      return fmt::format("[{}]", fmt::join(parts, ", "));
    case FieldKind::map:
      for (const std::string& name : row.names(member)) {
        parts.push_back(fmt::format("{} = {}", name, inline_table(row.child(), row.named(member, name))));
      }
      return fmt::format("{{{}}}", fmt::join(parts, ", "));
    default:
      return toml_value(row, member);
  }
}

std::string inline_table(const Table& table, void* owner) {
  std::vector<std::string> parts;
  for (const FieldRow& row : table) {
    parts.push_back(fmt::format("{} = {}", row.key, inline_value(row, row.member(owner))));
  }
  return fmt::format("{{{}}}", fmt::join(parts, ", "));
}

void collect(const Table& table, void* from, void* to, const std::string& prefix,
             std::vector<Assignment>& found);

void collect_named(const FieldRow& row, void* from, void* to, const std::string& key,
                   std::vector<Assignment>& found) {
  const std::vector<std::string> known = row.names(from);
  for (const std::string& name : row.names(to)) {
    const std::string item_key = key + "." + name;
    void* item = row.named(to, name);
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      found.push_back({item_key, inline_table(row.child(), item)});
    } else {
      collect(row.child(), row.named(from, name), item, item_key + ".", found);
    }
  }
}

void collect(const Table& table, void* from, void* to, const std::string& prefix,
             std::vector<Assignment>& found) {
  for (const FieldRow& row : table) {
    const std::string key = prefix + row.key;
    void* old_member = row.member(from);
    void* member = row.member(to);
    if (row.kind == FieldKind::group) {
      collect(row.child(), old_member, member, key + ".", found);
    } else if (row.kind == FieldKind::map) {
      collect_named(row, old_member, member, key, found);
    } else if (row.kind != FieldKind::list) {
      const std::string value = toml_value(row, member);
      if (value != toml_value(row, old_member)) found.push_back({key, value});
    } else if (row.size(old_member) != row.size(member)) {
      found.push_back({key, inline_value(row, member)});
    } else {
      for (std::size_t index = 0; index < row.size(member); ++index) {
        collect(row.child(), row.item(old_member, index), row.item(member, index),
                fmt::format("{}.{}.", key, index + 1), found);
      }
    }
  }
}

}  // namespace

std::vector<Assignment> differences(const Table& table, const void* from, const void* to) {
  std::vector<Assignment> found;
  // Rows hand out addresses of members; nothing is written through them here.
  collect(table, const_cast<void*>(from), const_cast<void*>(to), "", found);
  return found;
}

}  // namespace ramify
