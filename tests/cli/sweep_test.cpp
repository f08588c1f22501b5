// `ramify sweep`: what it makes, what it does not make again, and how it stands being killed.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <vector>

#include "common/base/files.h"
#include "common/base/image.h"
#include "tests/catch.h"
#include "tests/cli/page.h"
#include "tests/cli/program.h"
#include "tests/folder.h"

using namespace ramify;
using namespace ramify::test;
using nlohmann::json;

namespace fs = std::filesystem;

namespace {

/// Cells of a CSV file without quoted commas, a row each.
using Rows = std::vector<std::vector<std::string>>;

Rows rows_of(const std::string& csv) {
  Rows rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::string cell;
    bool is_quoted = false;
    for (const char c : line + ",") {
      if (c == '"') is_quoted = !is_quoted;
      if (c != ',' || is_quoted) {
        cell += c;
        continue;
      }
      rows.back().push_back(cell);
      cell.clear();
    }
  }
  return rows;
}

std::vector<std::string> column(const Rows& rows, const std::string& name) {
  const auto found = std::find(rows.at(0).begin(), rows.at(0).end(), name);
  REQUIRE(found != rows.at(0).end());
  std::vector<std::string> cells;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    cells.push_back(rows[i].at(static_cast<std::size_t>(found - rows[0].begin())));
  }
  return cells;
}

/// A sweep's table without what depends on the machine and the moment.
Rows without_costs(const std::string& csv) {
  Rows rows = rows_of(csv);
  for (const std::string cost : {"seconds", "peak_memory_bytes"}) {
    const auto at = std::find(rows.at(0).begin(), rows.at(0).end(), cost) - rows[0].begin();
    for (auto& row : rows) row.erase(row.begin() + at);
  }
  return rows;
}

/// All files of a sweep, hidden ones too; the bytes of those that depend on the config alone.
std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    const bool has_costs = entry.is_directory() || name == "results.csv" || name == "report.html" ||
                           name.starts_with("plots/") || name.ends_with("result.json");
    files[name] = has_costs ? "" : read_file(entry.path());
  }
  return files;
}

Outcome sweep(const std::string& arguments, const Folder& folder) {
  return run_program("sweep " + arguments, folder.path().string());
}

json outcome_of(const std::string& arguments, const Folder& folder) {
  const Outcome outcome = sweep(arguments + " --json --quiet", folder);
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  return json::parse(outcome.out);
}

}  // namespace

TEST_CASE("sweep: a row for each combination, the last key varying soonest, with the metrics of stats") {
  const Folder folder;
  const json outcome =
      outcome_of("s4-fig6 --vary growth.alpha=1.5,2 --vary seed=3:5:1 --steps 5 -o out", folder);
  CHECK(outcome["runs"] == 6);
  CHECK(outcome["made_now"] == 6);
  const Rows rows = rows_of(read_file(folder.file("out/results.csv")));
  CHECK(column(rows, "growth.alpha") == std::vector<std::string>{"1.5", "1.5", "1.5", "2", "2", "2"});
  CHECK(column(rows, "seed") == std::vector<std::string>{"3", "4", "5", "3", "4", "5"});
  CHECK(column(rows, "status") == std::vector<std::string>(6, "done"));

  const Rows stats = rows_of(run_program("stats s4-fig6 --set growth.alpha=2 --seed 4 --steps 5 --csv").out);
  for (std::size_t k = 1; k < stats.at(0).size(); ++k) {  // but for the input's name
    INFO(stats[0][k]);
    CHECK(column(rows, stats[0][k])[4] == stats.at(1)[k]);
  }
  for (const std::string& name : column(rows, "run")) {
    CHECK(name.size() == 16);
    const std::string config = folder.file("out/runs/" + name + "/config.toml");
    CHECK(run_program("check " + config).code == 0);
  }
  for (const std::string& seconds : column(rows, "seconds")) CHECK(std::stod(seconds) < 60.0);
  for (const std::string& bytes : column(rows, "peak_memory_bytes")) {
    CHECK(std::stod(bytes) > 1e6);
    CHECK(std::stod(bytes) < 1e9);
  }
}

TEST_CASE("sweep: steps are cut from one growing tree, byte for byte the runs of so many steps") {
  const Folder folder;
  const std::string where = folder.path().string();
  outcome_of("s4-fig8 --vary steps=5:7:1 -o cut", folder);
  for (const std::string steps : {"5", "6", "7"})
    outcome_of("s4-fig8 --vary steps=" + steps + " -o alone", folder);
  auto cut = files_of(folder.path() / "cut/runs");
  CHECK(cut.size() == 3 * 4);
  CHECK(cut == files_of(folder.path() / "alone/runs"));

  // An earlier step took no longer than a later one: they are of one run.
  const std::vector<std::string> seconds =
      column(rows_of(read_file(folder.file("cut/results.csv"))), "seconds");
  CHECK(std::stod(seconds[0]) <= std::stod(seconds[1]));
  CHECK(std::stod(seconds[1]) <= std::stod(seconds[2]));
}

TEST_CASE("sweep: a run tells how far it is while it grows, a byte each hundredth") {
  const Folder folder;
  fs::create_directory(folder.path() / "runs");
  const Outcome outcome = run_program("sweep-run s4-fig6 --at-step 3 -o runs", folder.path().string());
  CHECK(outcome.code == 0);
  CHECK(outcome.out == std::string(100, '.'));
}

TEST_CASE("sweep: a tree that stops at a limit says so, the steps before do not") {
  const Folder folder;
  outcome_of("s4-fig8 --set growth.max_internodes=300 --vary steps=3,7,8 -o cut", folder);
  for (const std::string steps : {"3", "7", "8"}) {
    outcome_of("s4-fig8 --set growth.max_internodes=300 --vary steps=" + steps + " -o alone", folder);
    const Rows alone = rows_of(read_file(folder.file("alone/results.csv")));
    const Rows cut = rows_of(read_file(folder.file("cut/results.csv")));
    const auto at = static_cast<std::size_t>(steps == "3" ? 0 : (steps == "7" ? 1 : 2));
    CHECK(column(cut, "message")[at] == column(alone, "message")[0]);
    CHECK(column(cut, "message")[at].empty() == (steps == "3"));
    CHECK(column(cut, "internodes")[at] == column(alone, "internodes")[0]);
    CHECK(column(cut, "status")[at] == "done");
  }
}

TEST_CASE("sweep: levels of planned trees are runs of their own") {
  const Folder folder;
  outcome_of("xm12-fig5 --vary steps=1,2 -o out", folder);
  const Rows rows = rows_of(read_file(folder.file("out/results.csv")));
  for (const std::string steps : {"1", "2"}) {
    const Rows stats = rows_of(run_program("stats xm12-fig5 --csv --steps " + steps).out);
    CHECK(column(rows, "height")[steps == "1" ? 0 : 1] == column(stats, "height")[0]);
  }
}

TEST_CASE("sweep: finished runs are not made again, new values make new runs only") {
  const Folder folder;
  const std::string values = " --vary growth.alpha=1.5,2";
  CHECK(outcome_of("s4-fig6 --steps 4" + values + " -o out", folder)["made_now"] == 2);
  const auto first = files_of(folder.path() / "out/runs");
  std::map<std::string, fs::file_time_type> times;
  for (const auto& [name, bytes] : first)
    times[name] = fs::last_write_time(folder.path() / "out/runs" / name);

  CHECK(outcome_of("s4-fig6 --steps 4" + values + " -o out", folder)["made_now"] == 0);
  CHECK(files_of(folder.path() / "out/runs") == first);
  CHECK(outcome_of("s4-fig6 --steps 4" + values + ",2.5 -o out", folder)["made_now"] == 1);
  CHECK(column(rows_of(read_file(folder.file("out/results.csv"))), "growth.alpha").size() == 3);
  CHECK(outcome_of("s4-fig6 --steps 5" + values + " -o out", folder)["made_now"] == 2);
  CHECK(outcome_of("s4-fig6 --steps 4 --set mesher.sides_max=7" + values + " -o out", folder)["made_now"] ==
        2);
  for (const auto& [name, bytes] : first) {
    CHECK(fs::last_write_time(folder.path() / "out/runs" / name) == times[name]);
  }

  // Whoever takes a run away has it made again; what was changed is not taken for a run's.
  const std::string name = first.begin()->first;
  fs::remove_all(folder.path() / "out/runs" / name);
  CHECK(outcome_of("s4-fig6 --steps 4" + values + " -o out", folder)["made_now"] == 1);
  CHECK(files_of(folder.path() / "out/runs").at(name + "/tree.skel.ply") ==
        first.at(name + "/tree.skel.ply"));
}

TEST_CASE("sweep: values of all kinds") {
  const Folder folder;
  outcome_of(
      "s4-fig6 --steps 3 --vary 'growth.lambda=[[1, 0.6], [8, 0.5]],0.5' --vary growth.tie=first,mean -o out",
      folder);
  const Rows rows = rows_of(read_file(folder.file("out/results.csv")));
  CHECK(column(rows, "growth.lambda")[0] == "\"[[1, 0.6], [8, 0.5]]\"");
  CHECK(column(rows, "growth.tie") == std::vector<std::string>{"first", "mean", "first", "mean"});

  outcome_of("s4-fig6 --steps 3 --vary growth.lambda=0.46:0.54:0.02 --vary seed=9:3:-3 -o range", folder);
  const Rows range = rows_of(read_file(folder.file("range/results.csv")));
  std::vector<std::string> lambdas;
  for (const std::string value : {"0.46", "0.48", "0.5", "0.52", "0.54"})
    lambdas.insert(lambdas.end(), 3, value);
  CHECK(column(range, "growth.lambda") == lambdas);
  CHECK(column(range, "seed")[2] == "3");
}

TEST_CASE("sweep: a run's config means the same files from any folder") {
  const Folder folder;
  fs::create_directory(folder.path() / "mine");
  std::ofstream(folder.file("mine/leaf.obj")) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(folder.file("mine/tree.toml"))
      << "base = \"s4-fig6\"\nsteps = 3\n[leaves]\nmesh = \"leaf.obj\"\n";
  outcome_of("mine/tree.toml --vary seed=1 -o out", folder);
  const std::string name = column(rows_of(read_file(folder.file("out/results.csv"))), "run")[0];
  const std::string config = folder.file("out/runs/" + name + "/config.toml");
  CHECK(read_file(config).find("mesh = \"" + folder.file("mine/leaf.obj") + "\"") != std::string::npos);
  CHECK(run_program("generate " + config + " -o a.glb --quiet", (folder.path() / "out").string()).code == 0);
}

TEST_CASE("sweep: a run is made again when a file that its config names has changed") {
  const Folder folder;
  std::ofstream(folder.file("leaf.obj")) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(folder.file("tree.toml")) << "base = \"s4-fig6\"\nsteps = 3\n[leaves]\nmesh = \"leaf.obj\"\n";
  const auto name = [&] {
    outcome_of("tree.toml --vary seed=1 -o out", folder);
    return column(rows_of(read_file(folder.file("out/results.csv"))), "run")[0];
  };
  const std::string before = name();
  CHECK(name() == before);
  std::ofstream(folder.file("leaf.obj")) << "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n";
  CHECK(name() != before);
}

TEST_CASE("sweep: a run that fails has its row and does not stop the others") {
  const Folder folder;
  const Outcome outcome = sweep(
      "xm12-fig22-sparse --vary pathplan.unreachable=error,warn --vary seed=1,2 -o out --quiet", folder);
  check_failure(outcome, 1, "2 of 4 runs failed (out/results.csv says why)\n");
  const Rows rows = rows_of(read_file(folder.file("out/results.csv")));
  CHECK(column(rows, "status") == std::vector<std::string>{"failed", "failed", "done", "done"});
  CHECK(column(rows, "message")[0].find("endpoints cannot be reached from the root (raise nodes") !=
        std::string::npos);
  CHECK(column(rows, "height")[0].empty());
  CHECK_FALSE(column(rows, "height")[3].empty());

  const std::string html = read_file(folder.file("out/report.html"));
  check_page(html);
  CHECK(html.find("2 of them failed") != std::string::npos);
  CHECK(count_of(html, "<mark>failed</mark>: 825 of 1500 endpoints") == 1);

  // Only what failed is tried again, and with the same end.
  CHECK(
      sweep("xm12-fig22-sparse --vary pathplan.unreachable=error,warn --vary seed=1,2 -o out --quiet", folder)
          .err == outcome.err);
}

TEST_CASE("sweep: of a tree whose later steps cannot be made the earlier ones are") {
  const Folder folder;
  // In 250 MB of address space a small tree grows and a large one does not.
  const Outcome outcome =
      run_shell("ulimit -v 250000; '" + program_path() + "' sweep p09-640k --vary steps=10,80 -o out --quiet",
                folder.path().string());
  check_failure(outcome, 1, "1 of 2 runs failed (out/results.csv says why)\n");
  const Rows rows = rows_of(read_file(folder.file("out/results.csv")));
  CHECK(column(rows, "status") == std::vector<std::string>{"done", "failed"});
  CHECK(column(rows, "message")[1].find("memory") != std::string::npos);
}

TEST_CASE("sweep: a run that is killed has its row") {
  const Folder folder;
  const Outcome outcome =
      run_shell("'" + program_path() +
                    "' sweep p09-fig7-50 --steps 50 --vary seed=1,2 --threads 1 -o out --quiet & sweep=$!\n"
                    "for i in $(seq 500); do child=$(cat /proc/$sweep/task/$sweep/children); [ -n \"$child\" "
                    "] && break; "
                    "sleep 0.01; done\n"
                    "kill -9 $child; wait $sweep",
                folder.path().string());
  CHECK(outcome.code == 1);
  CHECK(outcome.err.find("ramify: 1 of 2 runs failed") != std::string::npos);
  const Rows rows = rows_of(read_file(folder.file("out/results.csv")));
  CHECK(column(rows, "status") == std::vector<std::string>{"failed", "done"});
  CHECK(column(rows, "message")[0] == "ended by signal 9 (Killed); perhaps there was too little memory");
}

TEST_CASE("sweep: Ctrl-C ends the runs, leaves no halves and keeps what is finished") {
  const Folder folder;
  const std::string arguments = "p09-fig7-50 --vary seed=1:300:1 -o out";
  const Outcome outcome = run_shell(
      "'" + program_path() + "' sweep " + arguments +
          " --quiet & sweep=$!\n"
          "for i in $(seq 1000); do ls out/runs 2>/dev/null | grep -q . && break; sleep 0.01; done\n"
          "child=$(cat /proc/$sweep/task/$sweep/children | cut -d' ' -f1)\n"
          "kill -INT $sweep; wait $sweep; code=$?; kill -0 $child 2>/dev/null && echo alive; exit $code",
      folder.path().string());
  CHECK(outcome.code == 130);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.rfind("ramify: interrupted; ", 0) == 0);
  CHECK(outcome.err.find(" of 300 runs are made and kept; the same command goes on from there\n") !=
        std::string::npos);
  std::size_t finished = 0;
  for (const auto& entry : fs::directory_iterator(folder.path() / "out/runs")) {
    CHECK(entry.path().filename().string().front() != '.');
    CHECK(fs::exists(entry.path() / "result.json"));
    ++finished;
  }
  CHECK(finished >= 1);
  CHECK(finished < 300);
  CHECK_FALSE(fs::exists(folder.path() / "out/results.csv"));
}

TEST_CASE("sweep: killed ten times, it ends with what an undisturbed one has") {
  const Folder folder;
  const std::string arguments = "s4-fig6 --vary growth.alpha=1.5,2 --vary seed=1:50:1 --vary steps=3,4";
  outcome_of(arguments + " -o whole", folder);
  const Outcome killed =
      run_shell("RANDOM=7\nfor i in 1 2 3 4 5 6 7 8 9 10; do\n'" + program_path() + "' sweep " + arguments +
                    " -o out --quiet & sleep 0.$((RANDOM % 3))$((RANDOM % 10)); kill -9 $! && wait $!\n"
                    "echo $?\ndone 2>/dev/null",
                folder.path().string());
  CHECK(std::count(killed.out.begin(), killed.out.end(), '\n') == 10);
  CHECK(killed.out.find("137\n137\n137\n") != std::string::npos);
  outcome_of(arguments + " -o out", folder);
  CHECK(without_costs(read_file(folder.file("out/results.csv"))) ==
        without_costs(read_file(folder.file("whole/results.csv"))));
  CHECK(rows_of(read_file(folder.file("out/results.csv"))).size() == 201);
  auto out = files_of(folder.path() / "out");
  auto whole = files_of(folder.path() / "whole");
  out.erase("sweep.json");  // has the command, and in it the folder
  whole.erase("sweep.json");
  CHECK(out == whole);
}

TEST_CASE("sweep: the report is one well-formed page whose pictures lead to their configs") {
  const Folder folder;
  const std::string where = folder.path().string();
  // A name that HTML, the shell and gnuplot would each take for something else.
  std::ofstream(folder.file("a<b>&'c\".toml")) << "base = \"s4-fig6\"\nsteps = 4\n";
  const Outcome outcome = sweep(
      "'a<b>&'\\''c\".toml' --vary growth.alpha=1.5,2 --vary growth.tropism.up.weight=0,0.3 -o out", folder);
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.out.find("What changes most: ") != std::string::npos);
  const std::string html = read_file(folder.file("out/report.html"));
  const std::size_t pictures = check_page(html);
  CHECK(pictures == 4 + count_of(html, "<img src=\"data:image/svg"));
  CHECK((count_of(html, "<img src=\"data:image/svg") > 5) == has_gnuplot());
  CHECK(count_of(html, "<figure>") == pictures);
  CHECK(count_of(html, "<code class=\"command\">ramify ") == pictures);
  CHECK(count_of(html, "<figure><a href=\"#config-") == 4);
  CHECK(html.find("alt=\"The tree with alpha = 1.5, weight = 0.3\"") != std::string::npos);
  CHECK(count_of(html, "id=\"config-") == 4);

  const std::size_t begin = html.find("<code class=\"command\">ramify render") + 22;
  const std::string name = column(rows_of(read_file(folder.file("out/results.csv"))), "run")[0];
  const std::string command = html.substr(begin, html.find("</code>", begin) - begin);
  CHECK(command ==
        "ramify render &#39;a&lt;b&gt;&amp;&#39;\\&#39;&#39;c&quot;.toml&#39; --set growth.alpha=1.5 "
        "--set growth.tropism.up.weight=0 --size 240x240 -o " +
            name + ".png");
  CHECK(run_program("render 'a<b>&'\\''c\".toml' --set growth.alpha=1.5 --set growth.tropism.up.weight=0 "
                    "--size 240x240 -o a.png",
                    where)
            .code == 0);
}

TEST_CASE("sweep: pictures, contact sheet and plots stand beside the report") {
  const Folder folder;
  outcome_of("s4-fig6 --vary growth.alpha=1.5,2 --vary seed=1,2 --steps 5 -o out", folder);
  for (const std::string& name : column(rows_of(read_file(folder.file("out/results.csv"))), "run")) {
    const Image picture = decoded_image(read_file(folder.file("out/pictures/" + name + ".png")), name);
    CHECK(picture.width == 240);
    CHECK(picture.height == 240);
  }
  const Image sheet = decoded_image(read_file(folder.file("out/contact-sheet.png")), "sheet");
  CHECK(sheet.width == 480);  // a row a value of growth.alpha
  CHECK(sheet.height >= 480);
  const std::string html = read_file(folder.file("out/report.html"));
  CHECK(html.find("growth.alpha (1.5, 2) by seed (1, 2)") != std::string::npos);
  if (!has_gnuplot()) return;
  CHECK(html.find("Means over 2 seeds; bars show their standard deviation") != std::string::npos);
  CHECK(read_file(folder.file("out/plots/height.png")).rfind("\x89PNG", 0) == 0);
  CHECK(read_file(folder.file("out/plots/height.svg")).find("prefers-color-scheme: dark") !=
        std::string::npos);

  outcome_of("s4-fig6 --vary growth.tie=first,mean --steps 5 -o words", folder);
  CHECK(read_file(folder.file("words/plots/height.svg")).find("first") != std::string::npos);
  outcome_of(
      "s4-fig6 --vary growth.alpha=1.5,2 --vary growth.w_optimal=0,1 --vary growth.tie=first,mean --steps 4 "
      "-o three",
      folder);
  CHECK(read_file(folder.file("three/report.html")).find("3 keys vary, too many for a plot") !=
        std::string::npos);
}

TEST_CASE("sweep: all pictures are at one scale, and drawn anew only if it changes") {
  const Folder folder;
  outcome_of("s4-fig6 --vary steps=3,5 -o out", folder);
  const auto before = files_of(folder.path() / "out/pictures");
  const auto time = [&](const std::string& name) {
    return fs::last_write_time(folder.path() / "out/pictures" / name);
  };
  std::map<std::string, fs::file_time_type> times;
  for (const auto& [name, bytes] : before) times[name] = time(name);
  outcome_of("s4-fig6 --vary steps=3,4,5 -o out", folder);  // no larger tree
  for (const auto& [name, bytes] : before) CHECK(time(name) == times[name]);
  outcome_of("s4-fig6 --vary steps=3,4,5,8 -o out", folder);
  auto after = files_of(folder.path() / "out/pictures");
  for (const auto& [name, bytes] : before) CHECK(after[name] != bytes);
  CHECK(after.size() == 5);
}

TEST_CASE("sweep: pictures show the obstacles, at the scale of all others") {
  const Folder folder;
  outcome_of("xm12-obstacle --vary 'pathplan.obstacles.1.volume.center=[1.3,2.1,0],[1.8,2.1,0]' -o out",
             folder);
  // In front of the tree's foot there is nothing but the near end of the wall, and ground of one colour.
  std::vector<int> first;
  std::vector<int> width;
  for (const std::string& name : column(rows_of(read_file(folder.file("out/results.csv"))), "run")) {
    const Image picture = decoded_image(read_file(folder.file("out/pictures/" + name + ".png")), name);
    std::vector<int> wall;
    for (int x = 0; x < picture.width; ++x) {
      const auto blue = [&](int at) { return static_cast<int>(picture.pixel(at, 196)[2]); };
      if (std::abs(blue(x) - blue(0)) > 6) wall.push_back(x);
    }
    REQUIRE_FALSE(wall.empty());
    first.push_back(wall.front());
    width.push_back(static_cast<int>(wall.size()));
  }
  CHECK(width[0] > 4);
  CHECK(width[0] < 16);
  CHECK(std::abs(width[1] - width[0]) <= 4);  // its side is seen, too
  CHECK(first[1] > first[0] + 5);
}

TEST_CASE("sweep: numbers in the cells of a heat map are written out") {
  if (!has_gnuplot()) return;
  const Folder folder;
  outcome_of("s4-fig8 --vary growth.alpha=2,2.5 --vary growth.lambda=0.5 -o out", folder);
  const std::string map = read_file(folder.file("out/plots/internodes.svg"));
  for (const std::string& count : column(rows_of(read_file(folder.file("out/results.csv"))), "internodes")) {
    REQUIRE(count.size() == 4);
    CHECK(map.find(">" + count.substr(0, 1) + "," + count.substr(1) + "<") != std::string::npos);
  }
}

TEST_CASE("sweep: pictures have the same bytes whoever draws them, and only those that lack are drawn") {
  const Folder folder;
  outcome_of("s4-fig6 --vary seed=1:5:1 --threads 1 -o one", folder);
  outcome_of("s4-fig6 --vary seed=1:5:1 --threads 3 -o three", folder);
  const auto pictures = files_of(folder.path() / "one/pictures");
  CHECK(pictures.size() == 5 + 1);  // and their scale
  CHECK(files_of(folder.path() / "three/pictures") == pictures);
  CHECK(read_file(folder.file("one/contact-sheet.png")) == read_file(folder.file("three/contact-sheet.png")));

  const fs::path taken = folder.path() / "one/pictures" / pictures.begin()->first;
  std::map<std::string, fs::file_time_type> times;
  for (const auto& entry : fs::directory_iterator(taken.parent_path()))
    times[entry.path()] = entry.last_write_time();
  fs::remove(taken);
  CHECK(run_program("sweep -o one --collect --quiet", folder.path().string()).code == 0);
  CHECK(files_of(folder.path() / "one/pictures") == pictures);
  for (const auto& [path, time] : times) CHECK((fs::last_write_time(path) == time) == (path != taken));
}

TEST_CASE("sweep: without anything to draw with the report says so") {
  const Folder folder;
  const Outcome outcome =
      run_program("sweep s4-fig6 --vary growth.alpha=1.5,2 --steps 4 -o out --quiet", folder.path().string(),
                  "env __EGL_VENDOR_LIBRARY_FILENAMES=/dev/null ");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const std::string html = read_file(folder.file("out/report.html"));
  CHECK(html.find("There are no pictures: no OpenGL 3.3 to draw with: ") != std::string::npos);
  CHECK(check_page(html) == count_of(html, "<img src=\"data:image/svg"));
}

TEST_CASE("sweep: a process that is killed while it draws costs one picture, which the next sweep draws") {
  const Folder folder;
  const std::string command = "'" + program_path() + "' sweep p09-fig7-50 --vary seed=1:4:1 -o out --quiet";
  const Outcome outcome = run_shell(command +
                                        " --threads 1 & sweep=$!\n"
                                        "for i in $(seq 3000); do\n"
                                        "  ls out/pictures/*.png >/dev/null 2>&1 && break; sleep 0.01\n"
                                        "done\n"
                                        "kill -9 $(cat /proc/$sweep/task/$sweep/children); wait $sweep",
                                    folder.path().string());
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  const std::string html = read_file(folder.file("out/report.html"));
  const std::size_t pictures = count_of(html, "<img src=\"data:image/png");
  CHECK(pictures >= 3);  // all, if it was between two of them
  CHECK(count_of(html, "Pictures are missing: ended by signal 9 (Killed)") == 4 - pictures);

  REQUIRE(run_shell(command, folder.path().string()).code == 0);
  CHECK(count_of(read_file(folder.file("out/report.html")), "<img src=\"data:image/png") == 4);
  for (const auto& [name, bytes] : files_of(folder.path() / "out")) {
    INFO(name);
    CHECK(name.find("/.") == std::string::npos);  // what was half-written
  }
}

TEST_CASE("sweep: Ctrl-C while the pictures are drawn keeps those that are whole") {
  const Folder folder;
  const Outcome outcome = run_shell("'" + program_path() +
                                        "' sweep p09-fig7-50 --vary seed=1:12:1 -o out --quiet & sweep=$!\n"
                                        "for i in $(seq 3000); do\n"
                                        "  ls out/pictures/*.png >/dev/null 2>&1 && break; sleep 0.01\n"
                                        "done\n"
                                        "kill -INT $sweep; wait $sweep",
                                    folder.path().string());
  check_failure(outcome, 130, "interrupted; all runs are made; the same command goes on from there\n");
  std::size_t pictures = 0;
  for (const auto& entry : fs::directory_iterator(folder.path() / "out/pictures")) {
    CHECK(entry.path().filename().string().front() != '.');
    if (entry.path().extension() == ".png") ++pictures;
  }
  CHECK(pictures >= 1);
  CHECK(pictures < 12);
  CHECK_FALSE(fs::exists(folder.path() / "out/report.html"));
}

TEST_CASE("sweep: without gnuplot the report says so and has the tables") {
  const Folder folder;
  const Outcome outcome = run_program("sweep s4-fig6 --vary growth.alpha=1.5,2 --steps 4 -o out --quiet",
                                      folder.path().string(), "PATH=/nowhere ");
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK_FALSE(fs::exists(folder.path() / "out/plots"));
  const std::string html = read_file(folder.file("out/report.html"));
  CHECK(html.find("gnuplot is not installed") != std::string::npos);
  CHECK(html.find("<caption>height (m)</caption>") != std::string::npos);
  CHECK(check_page(html) == 2);
}

TEST_CASE("sweep: two at once in one folder are one too many") {
  const Folder folder;
  const Outcome outcome =
      run_shell("'" + program_path() +
                    "' sweep p09-fig7-50 --vary seed=1:300:1 -o out --quiet 2>/dev/null & sweep=$!\n"
                    "for i in $(seq 1000); do [ -e out/sweep.json ] && break; sleep 0.01; done\n"
                    "'" +
                    program_path() +
                    "' sweep s4-fig6 --vary seed=1 -o out; code=$?; kill $sweep; wait $sweep; exit $code",
                folder.path().string());
  check_failure(outcome, 1, "out: another `ramify sweep` is at work there\n");
}

TEST_CASE("sweep: what is wrong is one line, before anything is made") {
  const Folder folder;
  const std::string where = folder.path().string();
  const auto refused = [&](const std::string& arguments, const std::string& message, int code = 2) {
    INFO(arguments);
    check_failure(sweep("s4-fig6 " + arguments, folder), code, message);
  };
  refused("--vary growth.alpa=1,2 -o out",
          "--vary: growth.alpa: unknown key; did you mean 'growth.alpha'?\n");
  refused("--vary growth.alpha=1,x -o out", "--vary: growth.alpha: a string, 'x' (a number, 0 to 1000");
  refused("--vary growth.alpha=1,2000 -o out", "--vary: growth.alpha: 2000 is out of range (");
  refused("--vary growth.alpha -o out", "--vary: 'growth.alpha' is no KEY=LIST (a,b,c or from:to:step)\n");
  refused("--vary growth.alpha= -o out", "--vary: growth.alpha: a value is missing in '' (");
  refused("--vary growth.alpha=1,,2 -o out", "--vary: growth.alpha: a value is missing in '1,,2' (");
  refused("--vary growth.alpha=1:2 -o out",
          "--vary: growth.alpha: '1:2' is no range (a,b,c or from:to:step)\n");
  refused("--vary growth.alpha=a:2:1 -o out", "--vary: growth.alpha: 'a' is no number in 'a:2:1' (");
  refused("--vary growth.alpha=1:2:0 -o out",
          "--vary: growth.alpha: the step of '1:2:0' is 0 (more than 0, or less to go down)\n");
  refused("--vary growth.alpha=1:2:-0.5 -o out",
          "--vary: growth.alpha: '1:2:-0.5' is empty: a step of -0.5 leads from 1 away from 2 (a positive "
          "one goes "
          "up)\n");
  refused("--vary growth.alpha=2:1:0.5 -o out", "--vary: growth.alpha: '2:1:0.5' is empty: ");
  refused("--vary seed=0:9e9:1 -o out", "--vary: seed: '0:9e9:1' has 9e+09 values (at most 1000000)\n");
  refused("--vary seed=1:1000:1 --vary steps=1:11:1 -o out",
          "--vary: 11,000 combinations (at most 10,000)\n");
  refused("--vary seed=1 --vary seed=2 -o out",
          "--vary: seed: is there twice (one list of all its values)\n");
  refused("--vary seed=1 --seed 2 -o out", "--seed: seed is varied, too (one of them)\n");
  refused("--vary growth.alpha=1 --set growth.alpha=2 -o out",
          "--set: growth.alpha is varied, too (one of them)\n");
  refused("--vary mesher.sides_max=4,16 --set mesher.sides_min=8 -o out",
          "--set: mesher.sides_min: 8 is more than");
  refused("-o out", "--vary is required");
  refused("--vary seed=1", "--output is required");
  check_failure(sweep("s4-fig66 --vary seed=1 -o out", folder), 2, "s4-fig66: no such file or preset (");
  check_failure(sweep("xm12-fig5 --vary steps=1:3:1 -o out", folder), 2,
                "--vary: steps: 3 (there are 2 levels)\n");
  CHECK(folder.count() == 0);

  refused("--vary seed=1 -o none/out", "none/out: cannot write: there is no folder none\n", 1);
  std::ofstream(folder.file("file")) << "mine";
  refused("--vary seed=1 -o file", "file: is there already and no folder\n");
  fs::create_directory(folder.path() / "mine");
  fs::rename(folder.file("file"), folder.path() / "mine/file");
  refused("--vary seed=1 -o mine",
          "mine: is there already and no folder of `ramify sweep` (name another folder)\n");
  CHECK(folder.count() == 1);
  CHECK(read_file(folder.file("mine/file")) == "mine");
}

TEST_CASE("sweep: killed before its plan was written, it can be begun again") {
  const Folder folder;
  const fs::path out = folder.path() / "out";
  fs::create_directories(out / "runs");
  std::ofstream(out / ".sweep.json.17.tmp") << "{";
  const std::string command = "s4-fig6 --vary seed=1 --steps 2 -o out --quiet";
  std::ofstream(out / "runs/mine") << "mine";
  check_failure(sweep(command, folder), 2,
                "out: is there already and no folder of `ramify sweep` (name another folder)\n");
  fs::remove(out / "runs/mine");
  CHECK(sweep(command, folder).code == 0);
  CHECK(fs::exists(out / "results.csv"));
  CHECK_FALSE(fs::exists(out / ".sweep.json.17.tmp"));
}

TEST_CASE("sweep: help has examples that can be typed") {
  const Folder folder;
  const std::string help = run_program("sweep --help").out;
  CHECK(help.find("from:to:step") != std::string::npos);
  std::size_t examples = 0;
  for (std::size_t at = help.find("\n  ramify sweep "); at != std::string::npos;
       at = help.find("\n  ramify sweep ", at + 1)) {
    // Read and checked alone: whether the folder is there is looked at after the config.
    std::string line = help.substr(at + 16, help.find('\n', at + 1) - at - 16);
    line.replace(line.rfind("-o "), std::string::npos, "-o none/out");
    check_failure(sweep(line, folder), 1, "none/out: cannot write: there is no folder none\n");
    ++examples;
  }
  CHECK(examples >= 3);
  CHECK(run_program("--help").out.find("sweep-run") == std::string::npos);
}
