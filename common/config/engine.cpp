#include "common/config/engine.h"

#include <algorithm>

namespace ramify {

bool RunContext::wants(std::string_view layer) const {
  return std::find(layers.begin(), layers.end(), layer) != layers.end();
}

const AnyEngine* EngineRegistry::find(std::string_view name) const {
  for (const AnyEngine& engine : engines_) {
    if (engine.name == name) return &engine;
  }
  return nullptr;
}

std::vector<std::string> EngineRegistry::names() const {
  std::vector<std::string> result;
  for (const AnyEngine& engine : engines_) result.push_back(engine.name);
  return result;
}

}  // namespace ramify
