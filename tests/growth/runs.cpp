#include "tests/growth/runs.h"

#include <algorithm>

#include "common/config/presets.h"
#include "growth/engine.h"
#include "pathplan/engine.h"

namespace ramify::test {

growth::Parameters growth_parameters(const std::string& preset, const std::vector<std::string>& assignments) {
  EngineRegistry registry;
  growth::register_engine(registry);
  std::vector<Override> overrides;
  for (const std::string& assignment : assignments) {
    const std::size_t equals = assignment.find('=');
    overrides.push_back({"--set", assignment.substr(0, equals), assignment.substr(equals + 1)});
  }
  const Job job = load_job(registry, preset, overrides);
  return *static_cast<const growth::Parameters*>(job.parameters.get());
}

std::vector<std::string> growth_presets() {
  EngineRegistry registry;
  growth::register_engine(registry);
  pathplan::register_engine(registry);
  std::vector<std::string> names;
  for (const Preset& preset : presets()) {
    if (load_job(registry, std::string(preset.name)).engine->name == "growth")
      names.emplace_back(preset.name);
  }
  return names;
}

Vec3 relative_center_of_mass(const Skeleton& skeleton) {
  Vec3 moment(0.0);
  double volume = 0.0;
  Box box;
  for (std::size_t node = 0; node < skeleton.node_count(); ++node) {
    box.include(skeleton.position[node]);
    if (skeleton.is_root(node)) continue;
    const std::uint32_t parent = skeleton.parent[node];
    const double top = skeleton.diameter[node];
    const bool is_lateral_base = skeleton.axis[node] != skeleton.axis[parent];
    const double base = is_lateral_base ? top : skeleton.diameter[parent];
    const double piece = skeleton.length(node) * (base * base + base * top + top * top);
    volume += piece;
    moment += piece * 0.5 * (skeleton.position[node] + skeleton.position[parent]);
  }
  const Vec3 center = moment / volume / box.size().y;
  return {center.x, 0.0, center.z};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

}  // namespace ramify::test
