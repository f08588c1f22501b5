#include "common/config/job.h"

#include <algorithm>
#include <fstream>

#include "common/base/errors.h"
#include "growth/engine.h"
#include "pathplan/engine.h"
#include "tests/catch.h"
#include "tests/folder.h"

using namespace ramify;
using ramify::test::Folder;

namespace {

EngineRegistry registry() {
  EngineRegistry engines;
  growth::register_engine(engines);
  pathplan::register_engine(engines);
  return engines;
}

const growth::Parameters& growth_of(const Job& job) {
  return *static_cast<const growth::Parameters*>(job.parameters.get());
}

std::string write(const Folder& folder, const std::string& name, const std::string& text) {
  std::ofstream(folder.file(name)) << text;
  return folder.file(name);
}

std::string error_of(const std::string& config, const std::vector<Override>& overrides = {}) {
  const EngineRegistry engines = registry();
  try {
    load_job(engines, config, overrides);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

std::string error_in(const std::string& text) {
  const Folder folder;
  const std::string path = write(folder, "oak.toml", text);
  std::string message = error_of(path);
  const std::size_t at = message.find(folder.path().string() + "/");
  if (at != std::string::npos) message.erase(at, folder.path().string().size() + 1);
  return message;
}

}  // namespace

TEST_CASE("job: a preset, a file on top of it and overrides are laid over each other") {
  const EngineRegistry engines = registry();
  const Folder folder;
  const std::string path =
      write(folder, "mine.toml", "base = \"s4-fig6\"\nsteps = 6\n[growth]\nalpha = 1.5\n");
  const std::vector<Override> overrides = {{"--set", "growth.kappa", "0.25"}, {"--seed", "seed", "77"}};
  const Job job = load_job(engines, path, overrides);
  CHECK(job.engine->name == "growth");
  CHECK(job.steps() == 6);
  CHECK(job.seed() == 77);
  CHECK(growth_of(job).alpha.at(1) == 1.5);
  CHECK(growth_of(job).kappa.at(1) == 0.25);
  CHECK(growth_of(job).tropism.at("up").weight.at(1) == 0.3);
}

TEST_CASE("job: a base may be a file beside the config") {
  const EngineRegistry engines = registry();
  const Folder folder;
  write(folder, "low.toml", "engine = \"growth\"\nsteps = 3\n");
  const std::string path = write(folder, "high.toml", "base = \"low.toml\"\nseed = 2\n");
  CHECK(load_job(engines, path).steps() == 3);
}

TEST_CASE("job: what stands around the engine's table is checked too") {
  CHECK(error_in("") == "oak.toml: engine: missing (growth | pathplan)");
  CHECK(error_in("seed = 1\n") == "oak.toml: engine: missing (growth | pathplan)");
  CHECK(error_in("engine = \"groth\"\n") == "oak.toml:1: engine: 'groth' is not known (growth | pathplan)");
  CHECK(error_in("engine = 3\n") == "oak.toml:1: engine: a whole number (a string)");
  CHECK(error_in("base = \"s4-fig7\"\nengine = \"pathplan\"\n") ==
        "oak.toml:2: engine: 'pathplan' differs from the base's (growth)");
  CHECK(error_in("base = \"s4-fig66\"\n") ==
        "oak.toml:1: base: 's4-fig66': no such file or preset (did you mean 's4-fig6'?)");
  CHECK(error_in("base = \"oak.toml\"\n") ==
        "oak.toml:1: base: more than 16 configs based on each other (is it a circle?)");
  CHECK(error_in("engine = \"growth\"\n[pathplan]\n").rfind("oak.toml:2: pathplan: unknown key", 0) == 0);
  CHECK(error_in("engine = \"growth\"\nlambda = 0.5\n") ==
        "oak.toml:2: lambda: unknown key; did you mean 'growth.lambda'?");
  CHECK(error_in("engine = \"growth\"\n[growth]\nbraching_angle_deg = 40\n") ==
        "oak.toml:3: growth.braching_angle_deg: unknown key; did you mean 'growth.branching_angle_deg'?");
  CHECK(error_of("s4-fgi6") == "s4-fgi6: no such file or preset (did you mean 's4-fig6'?)");
  CHECK(error_of("qqqqqqqqqqqq") == "qqqqqqqqqqqq: no such file or preset (`ramify presets` lists them)");
}

TEST_CASE("job: what no range can say is found with file and line") {
  CHECK(error_in("engine = \"growth\"\n[growth]\nw_min = 2\n") ==
        "oak.toml:3: growth.w_min: 2 is more than w_max at step 0 (at most 1)");
  CHECK(error_in("engine = \"growth\"\n[growth.tropism.up]\ndirection = [0, 0, 0]\n") ==
        "oak.toml:3: growth.tropism.up.direction: [0, 0, 0] points nowhere (any other vector)");
  CHECK(error_in("engine = \"growth\"\n[mesher]\nsides_min = 20\n") ==
        "oak.toml:3: mesher.sides_min: 20 is more than sides_max (at most 12)");
  CHECK(error_of("s4-fig6", {{"--set", "growth.w_min", "5"}}) ==
        "--set: growth.w_min: 5 is more than w_max at step 0 (at most 1)");
  CHECK(error_of("xm12-fig5", {{"--steps", "steps", "9"}}).rfind("--steps: steps: ", 0) == 0);
}

TEST_CASE("job: a tree that will not grow is a warning") {
  const EngineRegistry engines = registry();
  const std::vector<Override> overrides = {{"--set", "growth.alpha", "0.5"}};
  const Job job = load_job(engines, "s4-fig6", overrides);
  REQUIRE(job.warnings.size() == 1);
  CHECK(job.warnings[0] ==
        "growth.alpha: the tree stays a seed: alpha0 + alpha * C = 0.5 at step 1 (a shoot takes 1)");
}

TEST_CASE("job: every number in every table has a finite range and every key a meaning") {
  const EngineRegistry engines = registry();
  std::function<void(const Table&, std::vector<const Table*>)> check = [&](const Table& table,
                                                                           std::vector<const Table*> around) {
    around.push_back(&table);
    for (const FieldRow& row : table) {
      INFO(row.key);
      CHECK(std::isfinite(row.info.min));
      CHECK(std::isfinite(row.info.max));
      const bool is_number = row.kind == FieldKind::number || row.kind == FieldKind::integer ||
                             row.kind == FieldKind::vector || row.kind == FieldKind::schedule ||
                             row.kind == FieldKind::sketch;
      if (is_number) CHECK(row.info.max > row.info.min);
      if (row.kind == FieldKind::choice) CHECK_FALSE(row.info.choices.empty());
      if (row.kind != FieldKind::group) CHECK_FALSE(row.info.help.empty());
      if (row.child && std::find(around.begin(), around.end(), &row.child()) == around.end()) {
        check(row.child(), around);
      }
    }
  };
  for (const AnyEngine& engine : engines.engines()) check(job_table(engine), {});
}

TEST_CASE("job: each file of a chain of bases names files from its own folder, --set from the working one") {
  const Folder folder;
  std::filesystem::create_directories(folder.path() / "crowns");
  const std::string points = "radius,height\n0,0\n1,2\n0,4\n";
  write(folder, "crowns/base.csv", points);
  write(folder, "own.csv", points);
  write(folder, "crowns/base.toml",
        "engine = \"pathplan\"\n[[pathplan.levels]]\nvolume.shape = \"revolution\"\n"
        "volume.file = \"base.csv\"\n");
  const std::string derived = write(folder, "derived.toml", "base = \"crowns/base.toml\"\n");
  const auto file_of = [&](const Job& job) {
    return static_cast<const pathplan::Parameters*>(job.parameters.get())
        ->levels.front()
        .volume.file.string();
  };
  const EngineRegistry engines = registry();
  const Job job = load_job(engines, derived);
  CHECK(file_of(job) == folder.file("crowns/base.csv"));
  CHECK(file_of(load_job(engines, write(folder, "again.toml", to_toml(job)))) == file_of(job));

  const std::string key = "pathplan.levels.1.volume.file";
  CHECK(file_of(load_job(engines, derived, std::vector<Override>{{"--set", key, folder.file("own.csv")}})) ==
        folder.file("own.csv"));
  CHECK(error_of(derived, {{"--set", key, "no/such.csv"}}) ==
        "--set: pathplan.levels.1.volume.file: no/such.csv: cannot read: No such file or directory");
  write(folder, "crowns/base.csv", "0,0\n-1,1\n0,2\n");
  CHECK(error_of(derived) == folder.file("crowns/base.toml") + ":4: pathplan.levels.1.volume.file: " +
                                 folder.file("crowns/base.csv") + ": point 2: radius -1 is less than 0");
}

TEST_CASE("job: a table by an item's number changes that item of the base's list and no other") {
  const Folder folder;
  write(folder, "base.toml",
        "engine = \"pathplan\"\n[[pathplan.levels]]\nb = 30\n[[pathplan.levels]]\nnodes = 100\nb = 8\n"
        "[[pathplan.levels]]\nb = 4\n");
  const auto levels_of = [&](const std::string& text) {
    const Job job = load_job(registry(), write(folder, "own.toml", "base = \"base.toml\"\n" + text));
    return static_cast<const pathplan::Parameters*>(job.parameters.get())->levels;
  };
  const std::vector<pathplan::Level> levels = levels_of("[pathplan.levels.2]\nb = 6\nguiding.d = 3\n");
  REQUIRE(levels.size() == 3);
  CHECK(levels[0].b == 30);
  CHECK(levels[1].b == 6);
  CHECK(levels[1].nodes == 100);
  CHECK(levels[1].guiding.d.at(0.0) == 3.0);
  CHECK(levels[2].b == 4);
  CHECK(levels[2].guiding.d.at(0.0) == 10.0);

  const auto problem = [&](const std::string& text) {
    const std::string file = write(folder, "own.toml", "base = \"base.toml\"\n" + text);
    return error_of(file).substr(file.size());
  };
  CHECK(problem("[pathplan.levels.4]\nb = 6\n") ==
        ":2: pathplan.levels.4: '4' is no item of pathplan.levels (1 to 3)");
  CHECK(problem("[pathplan.levels]\nb = 6\n") ==
        ":3: pathplan.levels.b: 'b' is no item of pathplan.levels (1 to 3)");
  CHECK(problem("[pathplan.levels]\n1 = 6\n") == ":3: pathplan.levels.1: a whole number (a table)");
  CHECK(problem("[pathplan.levels.2]\nb = 0\n") ==
        ":3: pathplan.levels.2.b: 0 is out of range (a whole number, 1 to 1000000)");
}

TEST_CASE("job: the complete config reads back to the same config") {
  const EngineRegistry engines = registry();
  for (const AnyEngine& engine : engines.engines()) {
    for (const bool with_comments : {false, true}) {
      const Folder folder;
      const std::string text = to_toml(default_job(engine), with_comments);
      const Job again = load_job(engines, write(folder, "all.toml", text));
      CHECK(to_toml(again) == to_toml(default_job(engine)));
    }
  }
}
