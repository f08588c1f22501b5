#include "common/config/differences.h"

#include "common/config/job.h"
#include "common/config/presets.h"
#include "growth/engine.h"
#include "pathplan/engine.h"
#include "tests/catch.h"

using namespace ramify;

namespace {

EngineRegistry registry() {
  EngineRegistry engines;
  growth::register_engine(engines);
  pathplan::register_engine(engines);
  return engines;
}

}  // namespace

TEST_CASE("differences: what was changed, as --set writes it, in the order of the table") {
  const EngineRegistry engines = registry();
  const Job before = load_job(engines, "s4-fig6");
  const std::vector<Override> overrides = {{"--set", "growth.tropism.up.weight", "0.5"},
                                           {"--set", "growth.lambda", "[[1, 0.6], [8, 0.5]]"},
                                           {"--set", "growth.allocation", "borchert-honda"},
                                           {"--seed", "seed", "7"}};
  const Job after = load_job(engines, "s4-fig6", overrides);
  const std::vector<Assignment> expected = {{"seed", "7"},
                                            {"growth.allocation", "\"borchert-honda\""},
                                            {"growth.lambda", "[[1, 0.6], [8, 0.5]]"},
                                            {"growth.tropism.up.weight", "0.5"}};
  CHECK(differences(job_table(*before.engine), &before, &after) == expected);
  CHECK(differences(job_table(*before.engine), &after, &after).empty());
}

TEST_CASE("differences: assigned to an engine's defaults they make any preset") {
  const EngineRegistry engines = registry();
  for (const Preset& preset : presets()) {
    INFO(preset.name);
    const Job wanted = load_job(engines, std::string(preset.name));
    Job job = default_job(*wanted.engine);
    const Table table = job_table(*wanted.engine);
    for (const auto& [key, value] : differences(table, &job, &wanted)) {
      Origins origins;
      INFO(key << " = " << value);
      CHECK_NOTHROW(assign(table, &job, key, value, "", origins));
    }
    CHECK(to_toml(job) == to_toml(wanted));
  }
}
