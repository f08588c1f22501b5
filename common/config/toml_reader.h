// TOML into the structs that tables describe. Every message names file, line, key, what is wrong and what is
// allowed.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/config/field.h"

namespace ramify {

/// Where each key was last set: "oak.toml:14" or "--set".
using Origins = std::map<std::string, std::string>;

/// A parsed text that remembers its file for messages.
class TomlDocument {
 public:
  /// `folder` is where the paths in it start from. Throws ConfigError at the line where `text` is no TOML.
  TomlDocument(std::string_view text, std::string file, std::filesystem::path folder = {});
  ~TomlDocument();

  /// A string at the top; empty if there is none. Throws ConfigError if it is something else.
  std::optional<std::string> top_string(std::string_view key) const;

  /// "oak.toml:14" for a key at the top; the file alone if it is not there.
  std::string where(std::string_view key) const;

  /// Sets the members of `owner`, whose table is `table`, that the text names, leaving the others. Keys at
  /// the top in `but_for` are somebody else's. Throws ConfigError for unknown keys, wrong types and values
  /// that are not allowed.
  void read_into(const Table& table, void* owner, const std::vector<std::string>& but_for,
                 Origins& origins) const;

 private:
  struct Parsed;
  std::unique_ptr<Parsed> parsed_;
};

/// One assignment, as in --set: `key` is dotted, list items count from 1; `value` is TOML, where a bare word
/// or path is a string. `where` stands before messages. Throws ConfigError.
void assign(const Table& table, void* owner, std::string_view key, std::string_view value,
            const std::string& where, Origins& origins);

}  // namespace ramify
