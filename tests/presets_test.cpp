// Every file in configs/ is tried here: a new preset needs no new test.

#include "common/config/presets.h"

#include <filesystem>
#include <set>

#include "common/config/job.h"
#include "common/mesh/tree_mesh.h"
#include "growth/engine.h"
#include "pathplan/engine.h"
#include "tests/catch.h"
#include "tests/pathplan/graphs.h"

using namespace ramify;
using namespace ramify::test;

namespace fs = std::filesystem;

namespace {

// Xu and Mould 2012, Fig. 22: a threshold graph with too few edges to hold together.
constexpr std::string_view kCutOff = "xm12-fig22-sparse";

EngineRegistry engines() {
  EngineRegistry registry;
  growth::register_engine(registry);
  pathplan::register_engine(registry);
  return registry;
}

}  // namespace

TEST_CASE("presets: every file in configs/ is in the program, under a name of its own") {
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(RAMIFY_SOURCE_DIR) / "configs")) {
    if (entry.path().extension() != ".toml") continue;
    ++files;
    const Preset* preset = find_preset(entry.path().stem().string());
    INFO(entry.path().string());
    REQUIRE(preset != nullptr);
    CHECK(preset->group == entry.path().parent_path().filename().string());
  }
  CHECK(presets().size() == files);
  std::set<std::string_view> names;
  for (const Preset& preset : presets()) names.insert(preset.name);
  CHECK(names.size() == files);
  CHECK(find_preset("no-such-preset") == nullptr);
}

TEST_CASE("presets: each opens with what it shows, its source and its time on 2 cores") {
  for (const Preset& preset : presets()) {
    INFO(preset.name);
    CHECK(preset.text.substr(0, 2) == "# ");
    CHECK(summary(preset).size() > 20);
    CHECK(summary(preset).size() < 110);
    const std::string_view comment = preset.text.substr(0, preset.text.find("\n\n"));
    CHECK(comment.find("# Source: ") != std::string_view::npos);
    CHECK(comment.find("Time on 2 cores: ") != std::string_view::npos);
  }
}

TEST_CASE(
    "presets: each makes a sound tree and mesh, warns only on purpose, and its complete config makes the "
    "same") {
  const EngineRegistry registry = engines();
  for (const Preset& preset : presets()) {
    INFO(preset.name);
    const Job job = load_job(registry, std::string(preset.name));
    CHECK(job.warnings.empty());
    const RunResult result = job.run({});
    CHECK(result.is_complete);
    CHECK(result.report.warnings.empty() == (preset.name != kCutOff));
    if (job.engine->name == "pathplan") {
      CHECK((reported(result, "graph", "unreachable") > 0.0) == (preset.name == kCutOff));
    }
    CHECK(violations(result.skeleton).empty());
    CHECK(result.skeleton.internode_count() > 20);
    CHECK(make_tree_mesh(result.skeleton, job.looks(), job.seed()).mesh.triangles.size() > 100);

    Job again = default_job(*job.engine);
    Origins origins;
    TomlDocument(to_toml(job), "complete").read_into(job_table(*job.engine), &again, {"engine"}, origins);
    CHECK(to_toml(again) == to_toml(job));
    CHECK(again.run({}).skeleton.position == result.skeleton.position);
  }
}

TEST_CASE("presets: the trees of Xu and Mould's Table 1 have its numbers of nodes and endpoints") {
  const std::set<std::pair<double, double>> printed = {{351'810, 34'740}, {207'458, 9'330}, {84'755, 3'732}};
  const EngineRegistry registry = engines();
  std::set<std::pair<double, double>> found;
  for (const Preset& preset : presets()) {
    if (preset.name.rfind("xm12-table1-", 0) != 0) continue;
    INFO(preset.name);
    const RunResult result = load_job(registry, std::string(preset.name)).run({});
    const std::pair<double, double> sizes(reported(result, "all_graphs", "nodes"),
                                          reported(result, "all_graphs", "endpoints"));
    INFO(sizes.first << " nodes, " << sizes.second << " endpoints");
    CHECK(printed.count(sizes) == 1);
    CHECK(found.insert(sizes).second);
  }
}
