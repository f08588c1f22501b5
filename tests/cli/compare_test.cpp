// `ramify compare`: the report as a browser would read it, and what cannot be compared.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "common/base/files.h"
#include "tests/catch.h"
#include "tests/cli/page.h"
#include "tests/cli/program.h"
#include "tests/folder.h"

using namespace ramify;
using namespace ramify::test;
using nlohmann::json;

namespace fs = std::filesystem;

namespace {

std::map<std::string, std::string> bytes_below(const fs::path& folder) {
  std::map<std::string, std::string> bytes;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) bytes[fs::relative(entry.path(), folder).string()] = read_file(entry.path());
  }
  return bytes;
}

}  // namespace

TEST_CASE("compare: the report is one well-formed page that needs nothing else") {
  const Folder folder;
  const std::string where = folder.path().string();
  // A name that HTML, the shell and gnuplot would each take for something else.
  const std::string odd = "a<b>&'c\".toml";
  std::ofstream(folder.file(odd)) << "base = \"s4-fig8\"\nsteps = 5\n";
  const Outcome outcome = run_program("compare s4-fig8 'a<b>&'\\''c\".toml' --seeds 2 -o out", where);
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.out.find("metrics differ by more than the spread between seeds") != std::string::npos);

  const std::string html = read_file(folder.file("out/report.html"));
  const std::size_t pictures = check_page(html);
  CHECK(pictures == 8 + (has_gnuplot() ? 4 : 0));
  CHECK(count_of(html, "<figure>") == pictures);
  CHECK(count_of(html, "<code class=\"command\">ramify ") == pictures);
  for (const std::string part :
       {"prefers-color-scheme: dark", "@media print", "a&lt;b&gt;&amp;&#39;c&quot;.toml",
        "by more than the spread between seeds", "crown_radius", "real trees"}) {
    INFO(part);
    CHECK(html.find(part) != std::string::npos);
  }
}

TEST_CASE("compare: the commands in the report can be typed") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(
      run_program("compare s4-fig8 s4-fig6 --set growth.alpha=1.5 --steps 5 -o out --quiet", where).code ==
      0);
  const std::string html = read_file(folder.file("out/report.html"));
  const std::size_t begin = html.find("<code class=\"command\">ramify render") + 22;
  const std::string command = html.substr(begin, html.find("</code>", begin) - begin);
  CHECK(command ==
        "ramify render s4-fig8 --set growth.alpha=1.5 --steps 5 --view front --size 480x480 "
        "-o 1-s4-fig8-front.png");
  CHECK(run_program(command.substr(7), where).code == 0);
  CHECK(html.find("<pre>ramify compare s4-fig8 s4-fig6 --set growth.alpha=1.5 --steps 5 -o out</pre>") !=
        std::string::npos);
}

TEST_CASE("compare: data, plots and pictures stand beside the report, the same bytes each time") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("compare s4-fig6 s4-fig8 --seeds 2 -o out --quiet", where).code == 0);
  const auto first = bytes_below(folder.path() / "out");
  REQUIRE(run_program("compare s4-fig6 s4-fig8 --seeds 2 -o out --quiet --threads 1", where).code == 0);
  CHECK(bytes_below(folder.path() / "out") == first);  // in the place of the first one
  CHECK(folder.count() == 1);

  const std::string metrics = first.at("metrics.csv");
  CHECK(metrics.rfind("input,seed,nodes,internodes,", 0) == 0);
  CHECK(std::count(metrics.begin(), metrics.end(), '\n') == 5);  // two trees of each
  const std::string distances = first.at("distances.csv");
  CHECK(distances.rfind("input_a,seed_a,input_b,seed_b,scatter,morphology,shape\n", 0) == 0);
  CHECK(std::count(distances.begin(), distances.end(), '\n') == 7);  // six pairs
  CHECK(first.at("spread.csv").find("\ncrown_radius,m,") != std::string::npos);
  CHECK(first.at("orders.csv").find("s4-fig8,2,1,") != std::string::npos);
  CHECK(first.at("distributions.csv").find("branching-angle,s4-fig8,41.25,") != std::string::npos);
  for (const std::string view : {"front", "side", "top", "schematic"}) {
    CHECK(first.at("pictures/1-s4-fig6-" + view + ".png").rfind("\x89PNG", 0) == 0);
  }
  const json about = json::parse(first.at("about.json"));
  CHECK(about["made_by"] == "ramify compare");
  CHECK(about["files"].size() == first.size() - 1);
  if (!has_gnuplot()) return;
  for (const std::string plot : {"branching-angle", "axis-length", "path-length", "width-by-order"}) {
    CHECK(first.at("plots/" + plot + ".png").rfind("\x89PNG", 0) == 0);
    CHECK(first.at("plots/" + plot + ".svg").find("prefers-color-scheme: dark") != std::string::npos);
  }
}

TEST_CASE("compare: clearly different presets are more than 3 times as far apart as seeds") {
  const Folder folder;
  const Outcome outcome =
      run_program("compare s4-fig8 xm12-fig5 --seeds 3 -o out --json --quiet", folder.path().string());
  REQUIRE(outcome.code == 0);
  const json object = json::parse(outcome.out);
  REQUIRE(object["distances"].size() == 3);
  for (const json& distance : object["distances"]) {
    INFO(distance.dump());
    CHECK(distance["between_over_within"] > 3.0);
    CHECK(distance["between"] > 0.3);
  }
}

TEST_CASE("compare: a preset is at no distance from itself") {
  const Folder folder;
  const Outcome outcome =
      run_program("compare s4-fig8 s4-fig8 -o out --json --quiet", folder.path().string());
  REQUIRE(outcome.code == 0);
  const json found = json::parse(outcome.out);
  REQUIRE_FALSE(found["distances"].empty());
  for (const json& distance : found["distances"]) {
    CHECK(distance["between"] == 0.0);
    CHECK(distance["between_over_within"].is_null());
    CHECK(distance["b"] == "s4-fig8 (2)");
  }
  const std::string html = read_file(folder.file("out/report.html"));
  CHECK(html.find("with --seeds 8 it is. No metric differs.") != std::string::npos);
}

TEST_CASE("compare: of a tree from a file there is one, whatever --seeds says") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("generate s4-fig6 --seed 5 -o tree.csv --quiet", where).code == 0);
  const Outcome outcome = run_program("compare tree.csv s4-fig6 --seeds 3 -o out", where);
  REQUIRE(outcome.code == 0);
  const std::string note = "tree.csv is a tree from a file: there is one tree of it, whatever --seeds says.";
  CHECK(outcome.err.find("ramify: note: " + note + "\n") != std::string::npos);
  CHECK(read_file(folder.file("out/report.html")).find(note) != std::string::npos);
  const std::string metrics = read_file(folder.file("out/metrics.csv"));
  CHECK(count_of(metrics, "\ntree.csv,,") == 1);
  CHECK(count_of(metrics, "\ns4-fig6,") == 3);
}

TEST_CASE("compare: a mesh that ramify made is a config, with seeds of its own") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("generate s4-fig6 --seed 5 -o tree.glb --quiet", where).code == 0);
  REQUIRE(run_program("compare tree.glb s4-fig6 --seeds 2 -o out --quiet", where).code == 0);
  const std::string metrics = read_file(folder.file("out/metrics.csv"));
  CHECK(count_of(metrics, "\ntree.glb,") == 2);
  CHECK(metrics.find("\ntree.glb,5,") != std::string::npos);
  CHECK(metrics.find("\ntree.glb,6,") != std::string::npos);
}

TEST_CASE("compare: without gnuplot the report says so and has the tables") {
  const Folder folder;
  const Outcome outcome =
      run_program("compare s4-fig6 s4-fig8 -o out --quiet", folder.path().string(), "PATH=/nowhere ");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK_FALSE(fs::exists(folder.path() / "out/plots"));
  const std::string html = read_file(folder.file("out/report.html"));
  CHECK(html.find("gnuplot is not installed") != std::string::npos);
  CHECK(html.find("branching angle (degrees)") != std::string::npos);
  check_page(html);
}

TEST_CASE("compare: what is wrong is one line, and nothing is written") {
  const Folder folder;
  const std::string where = folder.path().string();
  std::ofstream(folder.file("note.txt")) << "mine";
  fs::create_directory(folder.path() / "mine");
  fs::rename(folder.path() / "note.txt", folder.path() / "mine/note.txt");
  std::ofstream(folder.file("file")) << "mine";
  REQUIRE(run_program("generate s4-fig6 -o a.csv -o a.glb --quiet", where).code == 0);

  check_failure(run_program("compare s4-fig6 -o out", where), 2,
                "compare: s4-fig6 alone (two inputs or more)\n");
  check_failure(run_program("compare s4-fig6 s4-fig8", where), 2, "--output is required");
  check_failure(run_program("compare s4-fig6 s4-fig8 --seeds 0 -o out", where), 2, "--seeds: ");
  check_failure(run_program("compare s4-fig6 s4-fig88 -o out", where), 2,
                "s4-fig88: no such file or preset (did you mean 's4-fig8'?)\n");
  check_failure(run_program("compare s4-fig6 none.csv -o out", where), 2, "none.csv: ");
  std::ofstream(folder.file("b.gltf")) << "{\"asset\": {\"version\": \"2.0\"}}";
  check_failure(run_program("compare s4-fig6 b.gltf -o out", where), 2,
                "b.gltf: no config of ramify inside (files that `ramify generate` wrote have one)\n");
  check_failure(run_program("compare a.csv a.csv --seed 2 -o out", where), 2,
                "--seed: no input is a config\n");
  check_failure(run_program("compare s4-fig6 s4-fig8 --up z -o out", where), 2,
                "--up: no input is a skeleton file\n");
  check_failure(
      run_program("compare s4-fig6 s4-fig8 -o mine", where), 2,
      "mine: is there already and holds files that `ramify compare` did not make (name another folder)\n");
  check_failure(run_program("compare s4-fig6 s4-fig8 -o file", where), 2,
                "file: is there already and no folder\n");
  check_failure(run_program("compare s4-fig6 s4-fig8 -o none/out", where), 1,
                "none/out: cannot write: there is no folder ");
  CHECK(folder.count() == 5);
  CHECK(read_file(folder.file("mine/note.txt")) == "mine");
}

TEST_CASE("compare: a report that someone has put a file into is not replaced") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("compare s4-fig6 s4-fig8 -o out --quiet", where).code == 0);
  std::ofstream(folder.file("out/note.txt")) << "mine";
  CHECK(run_program("compare s4-fig6 s4-fig8 -o out --quiet", where).code == 2);
  CHECK(read_file(folder.file("out/note.txt")) == "mine");
}

TEST_CASE("compare: Ctrl-C leaves nothing") {
  const Folder folder;
  const std::string where = folder.path().string();
  const Outcome outcome = run_shell("'" + program_path() +
                                        "' compare p09-fig7-50 xm12-fig5 --seeds 500 -o out --quiet & "
                                        "sleep 1; kill -INT $!; wait $!",
                                    where);
  CHECK(outcome.code == 130);
  CHECK(outcome.err.find("ramify: interrupted; nothing written") != std::string::npos);
  CHECK(folder.count() == 0);
}
