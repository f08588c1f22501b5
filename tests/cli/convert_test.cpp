#include <algorithm>
#include <filesystem>
#include <fstream>

#include "common/base/files.h"
#include "common/config/presets.h"
#include "tests/catch.h"
#include "tests/cli/program.h"
#include "tests/folder.h"

using namespace ramify;
using namespace ramify::test;

namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("convert: from every form to every form and back to the same table") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("generate s4-fig3 -o a.csv -o a.skel.ply -o a.swc -o a.mtg", where).code == 0);
  const std::string table = read_file(folder.file("a.csv"));
  REQUIRE(run_program("convert a.skel.ply b.csv", where).code == 0);
  CHECK(read_file(folder.file("b.csv")) == table);
  for (const std::string form : {"swc", "mtg"}) {
    const Outcome outcome = run_program("convert a." + form + " b." + form, where);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK(read_file(folder.file("b." + form)).size() > 1000);
    const Outcome direct = run_program("convert a.csv c." + form, where);
    CHECK(direct.code == 0);
    CHECK(direct.err ==
          "ramify: note: c." + form + ": this form does not carry, left out: birthStep, light, vigour\n");
    CHECK(contains(direct.out, " internodes, "));
    CHECK(run_program("convert a.csv c." + form + " --quiet", where).err.empty());
  }
  // The first conversion numbers the axes as they stand in the file; the second finds them so.
  REQUIRE(run_program("convert b.mtg d.mtg", where).code == 0);
  CHECK((read_file(folder.file("b.mtg")) == read_file(folder.file("d.mtg"))));
  CHECK((read_file(folder.file("a.swc")).ends_with(read_file(folder.file("b.swc")).substr(200))));
  REQUIRE(run_program("convert a.csv q.csv --qsm simpleforest", where).code == 0);
  CHECK(read_file(folder.file("q.csv")).rfind(" ID, parentID, startX", 0) == 0);
  REQUIRE(run_program("convert q.csv q.swc", where).code == 0);
  REQUIRE(run_program("convert q.csv y.csv --up y", where).code == 0);
  CHECK(run_program("render q.csv a.skel.ply a.swc a.mtg -o p.png --size 64x64", where).code == 0);
}

TEST_CASE("convert: what cannot be is one line and leaves no file") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("generate s4-fig3 -o a.csv -o a.glb", where).code == 0);
  std::filesystem::create_directory(folder.path() / "f.csv");
  std::ofstream(folder.file("empty.csv"));
  std::ofstream(folder.file("garbage.skel.ply")) << "\x7f"
                                                    "ELF\x02\x01\n\xff\xfe";
  const std::size_t files = folder.count();
  struct Case {
    std::string arguments;
    int code;
    std::string message;
  };
  const std::vector<Case> cases = {
      {"a.glb b.csv", 2,
       "a.glb: a mesh, it holds no skeleton; if ramify made it, `ramify generate a.glb -o tree.csv` makes"},
      {"a.obj b.csv", 2, "a.obj: no skeleton file (.csv, .txt, .skel.ply, .swc, .mtg)\n"},
      {"a.csv b.glb", 2, "b.glb: not written by convert (.csv, .skel.ply, .swc, .mtg)\n"},
      {"a.csv b.swc --qsm simpleforest", 2, "--qsm: b.swc: SimpleForest's table ends in .csv\n"},
      {"a.csv b.csv --qsm treeqsm", 2, "--qsm: 'treeqsm' (simpleforest)\n"},
      {"a.csv b.csv --up x", 2, "--up: 'x' (y | z)\n"},
      {"none.csv b.csv", 2, "none.csv: cannot read: No such file or directory\n"},
      {"f.csv b.swc", 2, "f.csv: is a folder, not a file\n"},
      {"empty.csv b.swc", 2, "empty.csv:1: no column 'ID' ("},
      {"garbage.skel.ply b.swc", 2, "garbage.skel.ply:1: no PLY file (it begins with 'ply')\n"},
      {"a.csv no/b.swc", 1, "no/b.swc: cannot write: there is no folder no\n"},
  };
  for (const Case& c : cases) {
    check_failure(run_program("convert " + c.arguments, where), c.code, c.message);
    CHECK(folder.count() == files);
  }
  check_failure(run_program("render a.glb -o p.png --up z", where), 2, "--up: a.glb is no skeleton file\n");
}

#ifndef __SANITIZE_ADDRESS__  // which asks for terabytes
TEST_CASE("convert: files that claim more than they hold take no memory") {
  const Folder folder;
  const std::string where = folder.path().string();
  std::ofstream(folder.file("a.skel.ply"))
      << "ply\nformat binary_little_endian 1.0\nelement vertex 10000000000\nproperty double x\nproperty "
         "double "
         "y\nproperty double z\nproperty double diameter\nelement edge 10000000000\nproperty uint "
         "vertex1\nproperty uint vertex2\nend_header\n";
  std::ofstream(folder.file("a.csv")) << std::string(20000000, ',');
  std::ofstream(folder.file("a.swc")) << std::string(20000000, '9');
  std::ofstream(folder.file("a.mtg")) << "CLASSES:\nI\t3\nMTG:\nENTITY-CODE" << std::string(1000000, '\t');
  std::ofstream(folder.file("a.glb"), std::ios::binary)
      << std::string("glTF\2\0\0\0\xff\xff\xff\xff\xff\xff\xff\xf0JSON{}", 22);
  const std::string limited = "ulimit -v 1000000; '" + program_path() + "' ";
  for (const std::string& command :
       {std::string("convert a.skel.ply b.csv"), std::string("convert a.csv b.csv"),
        std::string("convert a.swc b.csv"), std::string("convert a.mtg b.csv"), std::string("check a.glb")}) {
    const Outcome outcome = run_shell(limited + command, where);
    INFO(command << ": " << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(outcome.err.size() < 300);
  }
}
#endif

TEST_CASE("generate: a file that ramify made makes the same files again") {
  const Folder folder;
  const std::string where = folder.path().string();
  for (const std::string preset :
       {"s4-fig3 --seed 9223372036854775807", "two-trees --steps 3", "xm12-fig5 --set seed=3"}) {
    REQUIRE(run_program("generate " + preset + " -o a.glb -o a.gltf -o a.skel.ply -o a.swc", where).code ==
            0);
    for (const std::string source : {"a.glb", "a.gltf", "a.skel.ply"}) {
      const Outcome outcome =
          run_program("generate " + source + " -o b.glb -o b.gltf -o b.skel.ply -o b.swc", where);
      INFO(preset << " from " << source << ": " << outcome.err);
      REQUIRE(outcome.code == 0);
      for (const std::string form : {"glb", "gltf", "skel.ply", "swc"}) {
        CHECK(read_file(folder.file("a." + form)) == read_file(folder.file("b." + form)));
      }
    }
  }
  // What is said on the command line goes over what is inside, and a config may be based on such a file.
  REQUIRE(run_program("generate s4-fig3 -o a.glb", where).code == 0);
  REQUIRE(run_program("generate s4-fig3 --seed 9 --set growth.kappa=0.3 -o c.csv", where).code == 0);
  REQUIRE(run_program("generate a.glb --seed 9 --set growth.kappa=0.3 -o d.csv", where).code == 0);
  CHECK(read_file(folder.file("c.csv")) == read_file(folder.file("d.csv")));
  std::ofstream(folder.file("mine.toml")) << "base = \"a.glb\"\nseed = 9\n[growth]\nkappa = 0.3\n";
  REQUIRE(run_program("generate mine.toml -o e.csv", where).code == 0);
  CHECK(read_file(folder.file("c.csv")) == read_file(folder.file("e.csv")));
  CHECK(run_program("check a.glb", where).out == "a.glb: sound (growth, 5 steps)\n");
}

TEST_CASE("generate: the paths in an embedded config start from the working folder") {
  const Folder folder;
  const std::string where = folder.path().string();
  std::filesystem::create_directories(folder.path() / "crowns");
  std::filesystem::create_directories(folder.path() / "out");
  std::ofstream(folder.file("crowns/line.csv")) << "radius,height\n0,0\n1,2\n0,4\n";
  std::ofstream(folder.file("crowns/oak.toml"))
      << "engine = \"pathplan\"\n[[pathplan.levels]]\nnodes = 2000\nvolume.shape = \"revolution\"\n"
         "volume.file = \"line.csv\"\n";
  REQUIRE(run_program("generate crowns/oak.toml -o out/a.glb", where).code == 0);
  REQUIRE(run_program("generate out/a.glb -o out/b.glb", where).code == 0);
  CHECK(read_file(folder.file("out/a.glb")) == read_file(folder.file("out/b.glb")));
  const Outcome elsewhere = run_program("generate a.glb", folder.file("out"));
  CHECK(elsewhere.code == 2);
  CHECK(contains(elsewhere.err, "crowns/line.csv: cannot read: No such file or directory"));
}

TEST_CASE("generate: a file without a config of ramify is one line") {
  const Folder folder;
  const std::string where = folder.path().string();
  const std::string none = "no config of ramify inside (files that `ramify generate` wrote have one)\n";
  std::ofstream(folder.file("a.gltf"))
      << "{\"asset\": {\"version\": \"2.0\"}, \"x\": {\"asset\": {\"extras\": "
         "{\"ramify\": {\"config\": \"engine\"}}}}}";
  std::ofstream(folder.file("b.gltf")) << "{\"asset\": {\"version\": \"2.0\"";
  std::ofstream(folder.file("c.glb")) << "glTF";
  std::ofstream(folder.file("d.skel.ply")) << "ply\nformat binary_little_endian 1.0\nend_header\n";
  std::filesystem::create_directory(folder.path() / "e.glb");
  check_failure(run_program("generate a.gltf", where), 2, "a.gltf: " + none);
  check_failure(run_program("generate b.gltf", where), 2, "b.gltf: no glTF: no JSON at byte ");
  check_failure(run_program("generate c.glb", where), 2,
                "c.glb: no glTF: its first part is no JSON within the file\n");
  check_failure(run_program("generate d.skel.ply", where), 2, "d.skel.ply: " + none);
  check_failure(run_program("generate e.glb", where), 2, "e.glb: is a folder, not a file\n");
  check_failure(run_program("generate none.glb", where), 2, "none.glb: no such file or preset (");
}
