// The structs that tables describe, as TOML that reads back to the same values.
#pragma once

#include <string>

#include "common/config/field.h"

namespace ramify {

struct TomlStyle {
  bool with_comments = false;  // meaning, unit, range and source above each key
};

/// All members of `owner`, whose table is `table`, defaults too. Numbers are printed so that they read back
/// to the same value.
std::string to_toml(const Table& table, const void* owner, const TomlStyle& style = {});

/// The value of one scalar member as TOML; `member` is its address.
std::string toml_value(const FieldRow& row, const void* member);

}  // namespace ramify
