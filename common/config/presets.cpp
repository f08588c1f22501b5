#include "common/config/presets.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "common/config/field.h"

namespace ramify {

extern const Preset kPresetTexts[];
extern const std::size_t kPresetCount;

std::span<const Preset> presets() {
  return {kPresetTexts, kPresetCount};
}

const Preset* find_preset(std::string_view name) {
  for (const Preset& preset : presets()) {
    if (preset.name == name) return &preset;
  }
  return nullptr;
}

std::string preset_hint(std::string_view name) {
  std::vector<std::string> names;
  for (const Preset& preset : presets()) names.emplace_back(preset.name);
  const std::string nearest = nearest_name(name, names);
  return nearest.empty() ? "`ramify presets` lists them" : fmt::format("did you mean '{}'?", nearest);
}

std::string_view summary(const Preset& preset) {
  const std::string_view line = preset.text.substr(0, preset.text.find('\n'));
  return line.substr(std::min(line.find_first_not_of("# "), line.size()));
}

}  // namespace ramify
