// `ramify stats` as scripts and people call it.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/base/files.h"
#include "tests/catch.h"
#include "tests/cli/program.h"
#include "tests/folder.h"

using namespace ramify;
using namespace ramify::test;
using nlohmann::ordered_json;

namespace {

/// The keys of the command line's contract.
const std::vector<std::string> kKeys = {"nodes",
                                        "internodes",
                                        "axes",
                                        "max_order",
                                        "height",
                                        "crown_radius",
                                        "crown_height",
                                        "crown_volume",
                                        "trunk_diameter",
                                        "dbh",
                                        "total_length",
                                        "wood_volume",
                                        "surface_area",
                                        "strahler_order",
                                        "bifurcation_ratio",
                                        "length_ratio",
                                        "diameter_ratio",
                                        "branching_angle_mean",
                                        "branching_angle_sd",
                                        "divergence_angle_mean",
                                        "internode_length_mean",
                                        "tortuosity_mean",
                                        "path_length_mean",
                                        "path_length_max",
                                        "fractal_dimension",
                                        "asymmetry",
                                        "lean",
                                        "by_order"};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

void check_failure(const std::string& arguments, const std::string& folder, const std::string& message) {
  const Outcome outcome = run_program(arguments, folder);
  INFO(arguments << ": " << outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.err == "ramify: " + message + "\n");
  CHECK(outcome.out.empty());
}

}  // namespace

TEST_CASE("stats: --json prints every key of the contract, one object a line an input") {
  const Outcome outcome = run_program("stats s4-fig6 xm12-fig5 --json");
  REQUIRE(outcome.code == 0);
  const std::vector<std::string> lines = lines_of(outcome.out);
  REQUIRE(lines.size() == 2);
  for (const std::string& line : lines) {
    const ordered_json object = ordered_json::parse(line);
    for (const std::string& key : kKeys) {
      INFO(key);
      CHECK(object.contains(key));
    }
    for (const std::string key :
         {"order", "axes", "length", "volume", "angle_mean", "angle_median", "tortuosity_mean"}) {
      INFO(key);
      CHECK(object["by_order"][0].contains(key));
    }
  }
  CHECK(ordered_json::parse(lines[0])["input"] == "s4-fig6");
  CHECK(ordered_json::parse(lines[0])["crown_volume"].is_null());  // a tree in a plane
  CHECK(ordered_json::parse(lines[1])["crown_volume"] > 0.0);
}

TEST_CASE("stats: a preset, its table and the counts of generate agree") {
  const Folder folder;
  const std::string where = folder.path().string();
  for (const std::string preset :
       {"s4-fig8", "xm12-fig5", "xm12-fig24a", "two-trees", "p09-fig7-50 --steps 9"}) {
    const Outcome made = run_program("generate " + preset + " -o a.csv --json", where);
    REQUIRE(made.code == 0);
    ordered_json one = ordered_json::parse(run_program("stats --json " + preset, where).out);
    ordered_json two = ordered_json::parse(run_program("stats --json a.csv", where).out);
    for (const std::string key : {"input", "nodes"}) {  // a table has one node for roots that share a place
      one.erase(key);
      two.erase(key);
    }
    INFO(preset);
    CHECK(one == two);
    const ordered_json generated = ordered_json::parse(made.out);
    CHECK(one["internodes"] == generated["internodes"]);
    CHECK(one["axes"] == generated["axes"]);
  }
}

TEST_CASE("stats: files that ramify made are measured as what they were made from") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("generate s4-fig6 --seed 4 -o a.glb -o a.gltf -o a.skel.ply", where).code == 0);
  const auto measured = [&](const std::string& input) {
    const Outcome outcome = run_program("stats --json " + input, where);
    INFO(input << ": " << outcome.err);
    REQUIRE(outcome.code == 0);
    ordered_json object = ordered_json::parse(outcome.out);
    object.erase("input");
    return object;
  };
  const ordered_json expected = measured("s4-fig6 --seed 4");
  for (const std::string input : {"a.glb", "a.gltf", "a.skel.ply"}) CHECK(measured(input) == expected);
  CHECK(measured("a.glb --seed 5") == measured("s4-fig6 --seed 5"));
  CHECK(measured("a.glb --at-step 3") == measured("s4-fig6 --seed 4 --at-step 3"));
}

TEST_CASE("stats: --csv prints a header and one row an input, empty where null") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("generate s4-fig6 -o 'a, b.csv'", where).code == 0);
  const Outcome outcome = run_program("stats --csv 'a, b.csv' s4-fig8", where);
  REQUIRE(outcome.code == 0);
  const std::vector<std::string> lines = lines_of(outcome.out);
  REQUIRE(lines.size() == 3);
  CHECK(lines[0].rfind("input,nodes,internodes,axes,max_order,height,crown_radius,", 0) == 0);
  CHECK(lines[1].rfind("\"a, b.csv\",93,92,16,1,", 0) == 0);
  CHECK(lines[1].find(",,") != std::string::npos);  // crown_volume
  const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
  CHECK(commas(lines[1]) == commas(lines[0]) + 1);
  CHECK(commas(lines[2]) == commas(lines[0]));
}

TEST_CASE("stats: the table shows what real trees have beside the values") {
  const Outcome outcome = run_program("stats s4-fig6 xm12-fig5 --quiet");
  REQUIRE(outcome.code == 0);
  CHECK(outcome.err.empty());
  for (const std::string text : {"real trees", "3-5", "0.36-0.93", "1.5-2.8", "xm12-fig5, by branch order"}) {
    INFO(text);
    CHECK(outcome.out.find(text) != std::string::npos);
  }
}

TEST_CASE("stats: --set, --seed, --steps and --at-step change what is measured") {
  const auto internodes = [](const std::string& flags) {
    const Outcome outcome = run_program("stats s4-fig8 --json " + flags);
    INFO(flags << outcome.err);
    REQUIRE(outcome.code == 0);
    return ordered_json::parse(outcome.out)["internodes"].get<int>();
  };
  const int whole = internodes("");
  CHECK(internodes("--steps 4") < whole);
  CHECK(internodes("--steps 4") == internodes("--at-step 4"));
  CHECK(internodes("--set growth.alpha=1") != whole);
  const Outcome one = run_program("stats xm12-fig5 --json --seed 1");
  CHECK(one.out != run_program("stats xm12-fig5 --json --seed 2").out);
  CHECK(one.out == run_program("stats xm12-fig5 --json --seed 1 --threads 1").out);
}

TEST_CASE("stats: a tree of one internode has values where they are defined") {
  const Folder folder;
  const std::string where = folder.path().string();
  std::ofstream(folder.file("pole.csv"))
      << "ID,parentID,startX,startY,startZ,endX,endY,endZ,radius,branchID,branchOrder\n"
      << "0,-1,0,0,0,0,2,0,0.1,0,0\n";
  const Outcome outcome = run_program("stats pole.csv --json", where);
  REQUIRE(outcome.code == 0);
  const ordered_json object = ordered_json::parse(outcome.out);
  CHECK(object["height"] == 2.0);
  CHECK(object["dbh"] == 0.2);
  CHECK(object["bifurcation_ratio"].is_null());
  CHECK(object["tortuosity_mean"].is_null());
  CHECK(object["by_order"].size() == 1);
}

TEST_CASE("stats: a scanned tree's cylinders, with Z up, are measured as they are") {
  const Folder folder;
  std::ofstream(folder.file("scan.csv")) << " ID, parentID, startX, startY, startZ, endX, endY, endZ, "
                                            "radius, length, segmentID, parentSegmentID, "
                                            "branchOrder, branchID\n"
                                            "0,-1,100,50,10,100,50,12,0.1,2,0,-1,0,0\n"
                                            "1,0,100,50,12,100,50,13,0.08,1,1,0,0,0\n"
                                            "2,0,100,50,12,102,50,12,0.05,2,2,0,1,1\n";
  const Outcome outcome = run_program("stats scan.csv --json --quiet", folder.path().string());
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const ordered_json object = ordered_json::parse(outcome.out);
  CHECK(object["height"] == Approx(3.0));
  CHECK(object["crown_radius"] == Approx(0.95 * 2.0));  // between the two tips
  CHECK(object["dbh"] == Approx(0.2));
  CHECK(object["branching_angle_mean"] == Approx(90.0));
  CHECK(object["wood_volume"] == Approx(std::acos(-1.0) * (2 * 0.01 + 0.0064 + 2 * 0.0025)));
}

TEST_CASE("stats: what is wrong is one line") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("generate s4-fig6 -o a.csv -o a.glb", where).code == 0);
  std::ofstream(folder.file("b.gltf")) << "{\"asset\": {\"version\": \"2.0\"}}";
  check_failure("stats b.gltf", where,
                "b.gltf: no config of ramify inside (files that `ramify generate` wrote have one)");
  check_failure("stats a.glb --up z", where, "--up: a.glb is no skeleton file");
  check_failure("stats s4-fig6 --csv --json", where, "--csv: not together with --json (one of them)");
  check_failure("stats s4-fig66", where, "s4-fig66: no such file or preset (did you mean 's4-fig6'?)");
  check_failure("stats s4-fig6 none.csv", where, "none.csv: cannot read: No such file or directory");
  check_failure("stats a.csv --seed 3", where, "--seed: a.csv goes with configs only");
  check_failure("stats s4-fig6 --up z", where, "--up: s4-fig6 is no skeleton file");
  check_failure("stats xm12-fig5 --at-step 2", where, "--at-step: xm12-fig5 has no steps");
  const Outcome none = run_program("stats", where);
  CHECK(none.code == 2);
  CHECK(none.err.find("input is required") != std::string::npos);
}

TEST_CASE("stats: a glTF file carries the metrics of its tree") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("generate s4-fig8 -o a.gltf --quiet", where).code == 0);
  const ordered_json file = ordered_json::parse(read_file(folder.file("a.gltf")));
  const ordered_json carried = file["asset"]["extras"]["ramify"]["metrics"];
  const ordered_json printed = ordered_json::parse(run_program("stats s4-fig8 --json").out);
  CHECK(carried.size() > 25);
  for (const auto& [key, value] : carried.items()) {
    INFO(key);
    CHECK(value.get<double>() == Approx(printed[key].get<double>()));
  }
  CHECK_FALSE(carried.contains("crown_volume"));  // a flat tree has none
}
