// What the program does when all is well.

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/base/files.h"
#include "common/config/presets.h"
#include "tests/catch.h"
#include "tests/cli/program.h"
#include "tests/folder.h"

using namespace ramify;
using namespace ramify::test;

namespace fs = std::filesystem;

namespace {

std::size_t lines(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("program: alone it prints four commands to try") {
  const Outcome outcome = run_program("");
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  std::size_t commands = 0;
  for (std::size_t at = 0; (at = outcome.out.find("\n  ramify ", at)) != std::string::npos; ++at) ++commands;
  CHECK(commands == 4);
}

TEST_CASE("program: help and version") {
  CHECK(run_program("--version").out.rfind("ramify 0.", 0) == 0);
  CHECK(contains(run_program("--help").out, "generate"));
  for (const std::string command : {"generate", "render", "check", "presets", "params"}) {
    const Outcome outcome = run_program(command + " --help");
    CHECK(outcome.code == 0);
    CHECK(outcome.out.size() > 100);
    CHECK(outcome.err.empty());
  }
}

TEST_CASE("generate: one run writes every file by its ending and says what it made") {
  const Folder folder;
  const Outcome outcome = run_program(
      "generate s4-fig6 -o a.glb -o a.gltf -o a.obj -o a.ply -o a.csv -o a.png --shadow a.vdb --json",
      folder.path().string());
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  const auto json = nlohmann::json::parse(outcome.out);
  CHECK(lines(outcome.out) == 1);
  CHECK(json["engine"] == "growth");
  CHECK(json["preset"] == "s4-fig6");
  CHECK(json["seed"] == 1);
  CHECK(json["steps"] == 5);
  CHECK(json["complete"] == true);
  CHECK(json["axes"].get<int>() > 5);
  CHECK(json["triangles"].get<int>() > 500);
  CHECK(json["seconds"].contains("shoots"));
  CHECK(json["peak_memory_bytes"].get<double>() > 1e6);
  CHECK(json["outputs"].size() == 10);  // an OBJ has two images
  for (const auto& file : json["outputs"]) CHECK(fs::file_size(folder.path() / file.get<std::string>()) > 40);
  CHECK(folder.count() == 10);

  const std::string table = read_file(folder.file("a.csv"));
  CHECK(lines(table) == json["internodes"].get<std::size_t>() + 1);
  CHECK(table.rfind(
            "ID,parentID,startX,startY,startZ,endX,endY,endZ,radius,length,branchID,branchOrder,birthStep,"
            "shedStep,level,light,vigour,kind\n",
            0) == 0);
  CHECK(read_file(folder.file("a.png")).substr(1, 3) == "PNG");
}

TEST_CASE("generate: without -o nothing is written and the summary still comes") {
  const Folder folder;
  const Outcome outcome = run_program("generate s4-fig6 --seed 3 --steps 4", folder.path().string());
  CHECK(outcome.code == 0);
  CHECK(folder.count() == 0);
  CHECK(contains(outcome.out, "s4-fig6 (growth, seed 3, 4 steps)"));
  const auto json = nlohmann::json::parse(run_program("generate s4-fig6 --json --quiet").out);
  CHECK(json["triangles"].is_null());
  CHECK(run_program("generate s4-fig6 --quiet").out.empty());
}

TEST_CASE("generate: the same bytes twice in a row and with 1 and 2 threads, for both engines", "[slow]") {
  for (const std::string preset : {"s4-improved", "xm12-fig5"}) {
    const Folder folder;
    std::vector<std::string> files;
    int run = 0;
    for (const std::string threads : {"1", "2", "2"}) {
      const std::string name = std::to_string(run++);
      const Outcome outcome =
          run_program("generate " + preset + " --threads " + threads + " -o " + name + ".glb -o " + name +
                          ".csv -o " + name + ".ply -o " + name + ".png",
                      folder.path().string());
      REQUIRE(outcome.code == 0);
    }
    for (const std::string ending : {".glb", ".csv", ".ply", ".png"}) {
      const std::string first = read_file(folder.file("0" + ending));
      INFO(preset << ending);
      CHECK(first.size() > 1000);
      CHECK(read_file(folder.file("1" + ending)) == first);
      CHECK(read_file(folder.file("2" + ending)) == first);
    }
  }
}

TEST_CASE("generate: the config inside a GLB makes the same tree again") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("generate s4-fig7 --seed 9 --set growth.alpha=1.8 -o a.glb -o a.csv", where).code == 0);
  const std::string glb = read_file(folder.file("a.glb"));
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  const auto json = nlohmann::json::parse(glb.substr(20, length));
  OutputFiles files;
  files.add(folder.file("again.toml")) << json["asset"]["extras"]["ramify"]["config"].get<std::string>();
  files.commit();
  REQUIRE(run_program("generate again.toml -o b.csv", where).code == 0);
  CHECK(read_file(folder.file("a.csv")) == read_file(folder.file("b.csv")));
}

TEST_CASE("generate: --at-step K is a run of K steps, byte for byte, but for light and vigour") {
  const Folder folder;
  const std::string where = folder.path().string();
  for (const std::string preset : {"s4-fig8", "p09-fig7-50 --set growth.shed_threshold=0.3"}) {
    REQUIRE(run_program("generate " + preset + " --at-step 6 -o cut.csv -o cut.ply -o cut.glb", where).code ==
            0);
    REQUIRE(run_program("generate " + preset + " --steps 6 -o run.csv -o run.ply -o run.glb", where).code ==
            0);
    const auto without_light = [&](const std::string& file) {
      return run_shell("cut -d, -f1-15,18 " + file, where).out;
    };
    CHECK(without_light("cut.csv") == without_light("run.csv"));
    CHECK(run_shell("tail -n +2 cut.csv | cut -d, -f16,17 | sort -u", where).out == ",\n");
    for (const std::string ending : {".ply", ".glb"}) {
      CHECK(read_file(folder.file("cut" + ending)) == read_file(folder.file("run" + ending)));
    }
  }
}

TEST_CASE("generate: trees that compete for space have markers and no shadow") {
  const Folder folder;
  const Outcome outcome = run_program("generate p09-fig7-50 --set growth.environment=space --shadow a.vdb",
                                      folder.path().string());
  CHECK(outcome.code == 2);
  CHECK(outcome.err == "ramify: a.vdb: growth with this config makes no shadow (it makes: markers)\n");
  CHECK(folder.count() == 0);
}

TEST_CASE("generate: --history writes shed internodes too") {
  const Folder folder;
  const std::string where = folder.path().string();
  const std::string preset = "generate p09-fig7-50 --steps 10 --set growth.shed_threshold=0.4 ";
  REQUIRE(run_program(preset + "-o all.csv --history", where).code == 0);
  REQUIRE(run_program(preset + "-o living.csv", where).code == 0);
  const std::string count_shed = "awk -F, 'NR > 1 && $14 != \"\"' ";
  CHECK(lines(run_shell(count_shed + "all.csv", where).out) > 10);
  CHECK(lines(run_shell(count_shed + "living.csv", where).out) == 0);
}

TEST_CASE("generate: the graph as tables, nodes beside edges") {
  const Folder folder;
  const std::string where = folder.path().string();
  const Outcome outcome = run_program("generate xm12-fig5 --graph g.csv --json", where);
  REQUIRE(outcome.code == 0);
  const auto json = nlohmann::json::parse(outcome.out);
  CHECK(json["graph"]["unreachable"] == 0);
  CHECK(json["graph"]["components"] == 1);
  CHECK(lines(read_file(folder.file("g.csv"))) == json["graph"]["edges"].get<std::size_t>() + 1);
  CHECK(lines(read_file(folder.file("g.nodes.csv"))) == json["graph"]["nodes"].get<std::size_t>() + 1);
}

TEST_CASE("generate: a run that stops at a limit is done, with a warning and its files") {
  const Folder folder;
  const Outcome outcome =
      run_program("generate s4-fig8 --set growth.max_internodes=500 -o a.glb --json", folder.path().string());
  CHECK(outcome.code == 0);
  CHECK(outcome.err.rfind("ramify: warning: stopped after step ", 0) == 0);
  CHECK(lines(outcome.err) == 1);
  CHECK(nlohmann::json::parse(outcome.out)["complete"] == false);
  CHECK(folder.count() == 1);
}

TEST_CASE("generate: a tree that does not grow still makes sound files") {
  const Folder folder;
  const Outcome outcome = run_program(
      "generate s4-fig6 --set growth.alpha=0.5 -o a.glb -o a.obj -o a.png -o a.csv", folder.path().string());
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err, "stays a seed"));
  CHECK(folder.count() == 5);
}

TEST_CASE("generate: --lod asks for fewer triangles, mesher keys for colours and a budget") {
  const Folder folder;
  const std::string where = folder.path().string();
  const auto triangles = [&](const std::string& arguments) {
    const Outcome outcome = run_program("generate s4-fig8 -o a.ply --json " + arguments, where);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    return nlohmann::json::parse(outcome.out)["triangles"].get<int>();
  };
  const int full = triangles("");
  CHECK(triangles("--lod 0") == full);
  CHECK(triangles("--lod 1") <= full / 3);
  CHECK(triangles("--lod 3") <= full / 27);
  CHECK(triangles("--set mesher.max_triangles=1000") <= 1000);
  CHECK(triangles("--set mesher.method=cones") > full);
  CHECK(triangles("--set mesher.centre_line=catmull-rom") > 1000);
  CHECK(triangles("--set mesher.color_by=order") == full);

  const Folder empty;
  const std::string there = empty.path().string();
  const Outcome unknown = run_program("generate s4-fig6 -o a.glb --set mesher.color_by=level", there);
  CHECK(unknown.code == 2);
  CHECK(contains(unknown.err, "mesher.color_by: the tree has no attribute 'level' (it has order, "));
  const Outcome level = run_program("generate s4-fig6 -o a.glb --lod 4", there);
  CHECK(level.code == 2);
  CHECK(contains(level.err, "mesher.lod: 4"));
  const Outcome budget = run_program("generate s4-fig6 -o a.glb --set mesher.max_triangles=1", there);
  CHECK(budget.code == 2);
  CHECK(contains(budget.err, "1 are allowed by lod and max_triangles"));
  CHECK(empty.count() == 0);
}

TEST_CASE("check: reads and validates and makes nothing") {
  const Folder folder;
  const Outcome outcome = run_program("check s4-fig6 xm12-fig5", folder.path().string());
  CHECK(outcome.code == 0);
  CHECK(outcome.out == "s4-fig6: sound (growth, 5 steps)\nxm12-fig5: sound (pathplan, 2 steps)\n");
  CHECK(folder.count() == 0);
  CHECK(contains(run_program("check s4-fig6 --set growth.alpha=0.9").err, "stays a seed"));
}

TEST_CASE("presets: the list, the names and one preset ready to edit") {
  const Folder folder;
  const std::string where = folder.path().string();
  const Outcome list = run_program("presets");
  for (const Preset& preset : presets()) CHECK(contains(list.out, std::string(summary(preset))));
  CHECK(lines(run_program("presets --names").out) == presets().size());
  CHECK(lines(run_program("presets --json").out) == presets().size());
  REQUIRE(run_shell("'" + program_path() + "' presets s4-fig7 > my.toml", where).code == 0);
  CHECK(run_program("check my.toml", where).code == 0);
  REQUIRE(run_program("generate my.toml -o a.csv", where).code == 0);
  REQUIRE(run_program("generate s4-fig7 -o b.csv", where).code == 0);
  CHECK(read_file(folder.file("a.csv")) == read_file(folder.file("b.csv")));
}

TEST_CASE("params: every parameter with default, meaning and source, and --toml is a config that runs") {
  const Folder folder;
  const std::string where = folder.path().string();
  const Outcome all = run_program("params");
  CHECK(contains(all.out, "growth.lambda = 0.5"));
  CHECK(contains(all.out, "pathplan.levels.N.zeta"));
  CHECK(contains(all.out, "growth.tropism.NAME.weight"));
  CHECK(contains(all.out, "mesher.sides_max"));
  CHECK_FALSE(contains(run_program("params growth").out, "pathplan."));
  for (const std::string engine : {"growth", "pathplan"}) {
    REQUIRE(run_shell("'" + program_path() + "' params --toml " + engine + " > all.toml", where).code == 0);
    CHECK(run_program("check all.toml", where).code == 0);
  }
  const Outcome json = run_program("params growth --json");
  CHECK(nlohmann::json::parse(json.out.substr(0, json.out.find('\n')))["key"] == "seed");
}

#ifndef __SANITIZE_ADDRESS__  // which asks for terabytes
TEST_CASE("generate: a thousand small trees ask for no more address space than they need") {
  const Folder folder;
  std::string text = "base = \"s4-fig6\"\nsteps = 3\n";
  for (int i = 0; i < 1000; ++i) {
    text += "[[growth.trees]]\nposition = [" + std::to_string(3 * (i % 40)) + ", 0, " +
            std::to_string(3 * (i / 40)) + "]\n";
  }
  std::ofstream(folder.file("many.toml")) << text;
  // 6 GB: the program and its threads take part of it, and memory limits of clusters are of this kind.
  const Outcome outcome = run_shell("ulimit -v 6000000; '" + program_path() + "' generate many.toml --json",
                                    folder.path().string());
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "\"internodes\":20"));
}
#endif
