// The configs in configs/, compiled into the program.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ramify {

struct Preset {
  std::string_view name;   // its file's, without ending
  std::string_view group;  // its folder's: the source it is from
  std::string_view text;   // TOML
};

/// All, sorted by group and name.
std::span<const Preset> presets();

/// nullptr if there is none of that name.
const Preset* find_preset(std::string_view name);

/// For messages about a name that is no preset's: "did you mean 's4-fig6'?", or how to list them.
std::string preset_hint(std::string_view name);

/// The first comment line of a preset: what it shows.
std::string_view summary(const Preset& preset);

}  // namespace ramify
