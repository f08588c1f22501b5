// What the program says when something is wrong: one line, the right exit code, no file.

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "common/base/files.h"
#include "tests/catch.h"
#include "tests/cli/program.h"
#include "tests/folder.h"

using namespace ramify;
using namespace ramify::test;

namespace fs = std::filesystem;

TEST_CASE("errors: bad configs are one line with file, line and key, exit code 2 and no file") {
  const Folder folder;
  const std::string where = folder.path().string();
  struct Case {
    std::string text;
    std::string message;
  };
  const std::vector<Case> cases = {
      {"", "oak.toml: engine: missing (growth | pathplan)\n"},
      {"engine = \"growth\n", "oak.toml:1: no TOML: "},
      {"engine = \"growth\"\n[growth\n", "oak.toml:2: no TOML: "},
      {"\x7f"
       "ELF\x02\x01",
       "oak.toml:1: no TOML: "},
      {"engine = \"growth\"\nsteps = \"five\"\n",
       "oak.toml:2: steps: a string, 'five' (a whole number, 1 to 10000)\n"},
      {"engine = \"growth\"\nsteps = 0\n",
       "oak.toml:2: steps: 0 is out of range (a whole number, 1 to 10000)\n"},
      {"engine = \"growth\"\n[growth]\nbraching_angle_deg = 3\n",
       "oak.toml:3: growth.braching_angle_deg: unknown key; did you mean 'growth.branching_angle_deg'?\n"},
      {"engine = \"growth\"\n[growth]\nlambda = 7\n",
       "oak.toml:3: growth.lambda: 7 is out of range (a number, 0 to 1,"},
      {"engine = \"growth\"\n[growth]\na = nan\n",
       "oak.toml:3: growth.a: nan is out of range (a number, more than 0 to 10)\n"},
      {"engine = \"growth\"\n[growth]\na = inf\n",
       "oak.toml:3: growth.a: inf is out of range (a number, more than 0 to 10)\n"},
      {"engine = \"growth\"\n[growth]\nalpha = 1e308\n", "oak.toml:3: growth.alpha: 1e+308 is out of range"},
      {"engine = \"growth\"\n[growth]\nq_max = 1e308\n",
       "oak.toml:3: growth.q_max: 1e+308 is no whole number"},
      {"engine = \"growth\"\nseed = 9223372036854775808\n", "oak.toml:2: no TOML: "},
      {"engine = \"pathplan\"\nseed = -4\n",
       "oak.toml:2: seed: -4 is out of range (a whole number, 0 to 9223372036854775807)\n"},
  };
  for (const Case& c : cases) {
    std::ofstream(folder.file("oak.toml")) << c.text;
    check_failure(run_program("generate oak.toml -o tree.glb", where), 2, c.message);
    check_failure(run_program("check oak.toml", where), 2, c.message);
    CHECK(folder.count() == 1);
  }
}

TEST_CASE("errors: configs that are no files") {
  const Folder folder;
  const std::string where = folder.path().string();
  fs::create_directory(folder.path() / "folder.toml");
  check_failure(run_program("generate none.toml -o a.glb", where), 2, "none.toml: no such file or preset (");
  check_failure(run_program("generate folder.toml -o a.glb", where), 2,
                "folder.toml: is a folder, not a file\n");
  check_failure(run_program("generate s4-fig66", where), 2,
                "s4-fig66: no such file or preset (did you mean 's4-fig6'?)\n");
  CHECK(folder.count() == 1);
}

TEST_CASE("errors: outputs that cannot be are found before the engine starts") {
  const Folder folder;
  const std::string where = folder.path().string();
  fs::create_directory(folder.path() / "folder.glb");
  check_failure(
      run_program("generate s4-fig6 -o a.xyz", where), 2,
      "a.xyz: unknown ending '.xyz' (.glb .gltf .obj .skel.ply .ply .stl .pov .csv .swc .mtg .png .vdb)\n");
  check_failure(run_program("generate s4-fig6 -o a", where), 2, "a: unknown ending ''");
  check_failure(run_program("generate s4-fig6 -o a.glb -o ./a.glb", where), 2,
                "./a.glb: two outputs would write this file\n");
  check_failure(run_program("generate s4-fig6 -o no/a.glb", where), 1,
                "no/a.glb: cannot write: there is no folder no\n");
  check_failure(run_program("generate s4-fig6 -o a.csv -o folder.glb", where), 1,
                "folder.glb: is a folder, not a file\n");
  check_failure(run_program("generate xm12-fig5 --shadow a.vdb", where), 2,
                "a.vdb: pathplan with this config makes no shadow (it makes: graph, endpoints)\n");
  check_failure(run_program("generate s4-fig6 --graph a.csv", where), 2,
                "a.csv: growth with this config makes no graph (it makes: shadow)\n");
  check_failure(run_program("generate s4-fig6 --at-step 9 -o a.glb", where), 2,
                "--at-step: 9 is after the last step (0 to 5)\n");
  check_failure(run_program("generate xm12-fig5 --at-step 1 -o a.glb", where), 2,
                "--at-step: trees of the engine 'pathplan' have no steps\n");
  CHECK(folder.count() == 1);
}

TEST_CASE("errors: a full disk leaves the old file and no other") {
  const Folder folder;
  const std::string where = folder.path().string();
  std::ofstream(folder.file("a.glb")) << "old";
  // A limit of 1 KiB a file stands for the disk; ignored, its signal becomes a failing write.
  const Outcome outcome = run_shell(
      "trap '' XFSZ; ulimit -f 1; '" + program_path() + "' generate s4-fig8 -o a.glb -o b.csv", where);
  check_failure(outcome, 1, "a.glb: cannot write: File too large\n");
  CHECK(read_file(folder.file("a.glb")) == "old");
  CHECK(folder.count() == 1);
}

TEST_CASE("errors: endpoints that no path leads to end the run, or are left out with a warning") {
  const Folder folder;
  const std::string where = folder.path().string();
  const std::string command = "generate xm12-fig22-sparse -o a.csv --set pathplan.unreachable=";
  const Outcome failed = run_program(command + "error", where);
  CHECK(failed.code == 1);
  CHECK(failed.err.find("of 1500 endpoints cannot be reached from the root (raise nodes or max_edge, ") !=
        std::string::npos);
  CHECK(std::count(failed.err.begin(), failed.err.end(), '\n') == 1);
  CHECK(folder.count() == 0);
  const Outcome warned = run_program(command + "warn", where);
  CHECK(warned.code == 0);
  CHECK(warned.err.find("ramify: warning: ") == 0);
  CHECK(warned.err.find("of 1500 endpoints cannot be reached from the root: they are left out\n") !=
        std::string::npos);
  CHECK(folder.count() == 1);
}

TEST_CASE("errors: a planned tree's config is told with its level, value and what is allowed") {
  check_failure(run_program("generate xm12-fig7 --set pathplan.levels.2.sectors=7"), 2,
                "--set: pathplan.levels.2.sectors: 7 (6, 8 or 14)\n");
  check_failure(run_program("generate xm12-fig7 --set pathplan.levels.9.b=7"), 2,
                "--set: pathplan.levels.9: '9' is no item of pathplan.levels (1 to 4)\n");
  check_failure(run_program("generate xm12-fig7 --set pathplan.light.b_low=2"), 2,
                "--set: pathplan.light.b_low: 2 is more than b_high, 1 (at most as much)\n");
}

TEST_CASE("errors: a full disk behind stdout is a failure") {
  const Outcome outcome = run_shell("'" + program_path() + "' presets > /dev/full");
  CHECK(outcome.code == 1);
  CHECK(outcome.err == "ramify: cannot write to standard output\n");
}

TEST_CASE("errors: commands, flags and values that are not known are named, with what is near") {
  check_failure(run_program("genrate s4-fig6"), 2, "'genrate' is not known (did you mean 'generate'?)\n");
  check_failure(run_program("generate s4-fig6 --sede 4"), 2,
                "'--sede' is not known (did you mean '--seed'?)\n");
  check_failure(run_program("generate s4-fig6 qqqqqqqqqqqq"), 2, "'qqqqqqqqqqqq' is not known");
  check_failure(run_program("generate"), 2, "config is required\n");
  check_failure(run_program("generate s4-fig6 --threads many"), 2, "--threads");
  check_failure(run_program("generate s4-fig6 --set alpha"), 2, "--set: 'alpha' is no KEY=VALUE\n");
  check_failure(run_program("generate s4-fig6 --set growth.lamda=0.5"), 2,
                "--set: growth.lamda: unknown key; did you mean 'growth.lambda'?\n");
  check_failure(run_program("generate s4-fig6 --set growth.lambda=7"), 2,
                "--set: growth.lambda: 7 is out of range");
  check_failure(run_program("generate s4-fig6 --seed abc"), 2,
                "--seed: seed: a string, 'abc' (a whole number, 0 to 9223372036854775807)\n");
  check_failure(run_program("generate s4-fig6 --steps 99999"), 2, "--steps: steps: 99999 is out of range");
  check_failure(run_program("generate xm12-fig5 --steps 5"), 2, "--steps: steps: ");
  check_failure(run_program("presets s4-fig66"), 2, "s4-fig66: no such preset (did you mean 's4-fig6'?)\n");
  check_failure(run_program("params oak"), 2, "'oak' is no engine (growth | pathplan)\n");
  check_failure(run_program("params --toml"), 2, "--toml: name the engine (growth | pathplan)\n");
}

TEST_CASE("errors: Ctrl-C ends a run with 130 and nothing written") {
  const Folder folder;
  const std::string where = folder.path().string();
  // A tree that takes far longer than the second it is given; bash does not let background jobs have SIGINT,
  // so the signal is SIGTERM, which is handled alike.
  const Outcome outcome = run_shell(
      "'" + program_path() + "' generate p09-fig7-50 --steps 400 -o a.glb & sleep 1; kill -TERM $!; wait $!",
      where);
  CHECK(outcome.code == 130);
  CHECK(outcome.err == "ramify: interrupted; nothing written\n");
  CHECK(folder.count() == 0);
}

TEST_CASE("errors: a broken table or mesh is one line with its row") {
  const Folder folder;
  const std::string where = folder.path().string();
  std::ofstream(folder.file("a.csv")) << "ID,parentID\n0,-1\n";
  std::ofstream(folder.file("b.glb")) << "glTF garbage";
  check_failure(run_program("render a.csv -o p.png", where), 2, "a.csv:1: no column 'startX'");
  check_failure(run_program("render b.glb -o p.png", where), 2, "b.glb: no glTF: ");
  CHECK(folder.count() == 2);
}

TEST_CASE("progress: plain lines without a terminal begin after two seconds, and --quiet has none",
          "[slow]") {
  const std::string run = "generate p09-fig7-50 --steps 300 --set growth.max_internodes=3000000 ";
  const Outcome short_run = run_program("generate s4-fig6");
  CHECK(short_run.err.empty());
  const Outcome shown = run_shell("timeout -s TERM 8 '" + program_path() + "' " + run);
  CHECK(shown.err.find("growing: ") != std::string::npos);
  CHECK(shown.err.find('\r') == std::string::npos);
  const Outcome quiet = run_shell("timeout -s TERM 4 '" + program_path() + "' " + run + "--quiet");
  CHECK(quiet.err.find("growing: ") == std::string::npos);
}
