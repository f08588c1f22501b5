// In what two configs of the same tables differ, as assignments.
#pragma once

#include <string>
#include <vector>

#include "common/config/field.h"

namespace ramify {

/// What --set takes: a dotted key, list items counted from 1, and its value as TOML on one line.
struct Assignment {
  std::string key;
  std::string value;

  bool operator==(const Assignment&) const = default;
};

/// Assigned one after the other to an owner that is like `from`, these make it like `to`; in the order of the
/// table. A list of another length is assigned as a whole. A named item that `to` lacks stays: no assignment
/// takes one away. O(members).
std::vector<Assignment> differences(const Table& table, const void* from, const void* to);

}  // namespace ramify
