#include "common/config/presets.h"

#include <algorithm>

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

std::string_view summary(const Preset& preset) {
  const std::string_view line = preset.text.substr(0, preset.text.find('\n'));
  return line.substr(std::min(line.find_first_not_of("# "), line.size()));
}

}  // namespace ramify
