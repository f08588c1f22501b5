// The experiments in configs/experiments: the command in the head of each runs as it stands and shows what
// the head says.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "common/base/files.h"
#include "tests/catch.h"
#include "tests/cli/program.h"
#include "tests/folder.h"

using namespace ramify;
using namespace ramify::test;

namespace fs = std::filesystem;

namespace {

const fs::path kExperiments = fs::path(RAMIFY_SOURCE_DIR) / "configs/experiments";

/// What stands after "ramify" in the one line of the experiment's head that is a command.
std::string command_of(const std::string& experiment) {
  std::istringstream lines(read_file(kExperiments / (experiment + ".toml")));
  const std::string mark = "# ramify ";
  std::string command;
  for (std::string line; std::getline(lines, line) && line.rfind("#", 0) == 0;) {
    if (line.rfind(mark, 0) != 0) continue;
    CHECK(command.empty());
    command = line.substr(mark.size());
  }
  REQUIRE_FALSE(command.empty());
  return command;
}

std::string folder_in(const std::string& command) {
  return command.substr(command.rfind(" -o ") + 4);
}

/// A table without quoted commas: a map from column to cell for each row.
using Table = std::vector<std::map<std::string, std::string>>;

Table table_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::vector<std::string> header;
  Table rows;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    row.resize(std::max(row.size(), header.size()));
    if (header.empty()) {
      header = row;
      continue;
    }
    rows.emplace_back();
    for (std::size_t i = 0; i < header.size(); ++i) rows.back()[header[i]] = row[i];
  }
  return rows;
}

/// Runs the experiment from an empty folder, as an installed program would; the sweep's rows.
Table sweep_of(const std::string& experiment) {
  const Folder folder;
  const std::string command = command_of(experiment);
  const Outcome outcome = run_program(command + " --quiet", folder.path().string());
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const Table rows = table_of(read_file(folder.path() / folder_in(command) / "results.csv"));
  for (const auto& row : rows) CHECK(row.at("status") == "done");
  return rows;
}

using Cells = std::map<std::string, std::string>;

/// The mean of a metric over the rows in which the keys have these values.
double mean_of(const Table& rows, const Cells& cells, const std::string& metric) {
  double sum = 0.0;
  int count = 0;
  for (const auto& row : rows) {
    const bool fits = std::all_of(cells.begin(), cells.end(),
                                  [&](const auto& cell) { return row.at(cell.first) == cell.second; });
    if (!fits) continue;
    sum += std::stod(row.at(metric));
    ++count;
  }
  REQUIRE(count > 0);
  return sum / count;
}

}  // namespace

TEST_CASE("experiments: each file's command names the file and is sound") {
  const Folder folder;
  int files = 0;
  for (const auto& entry : fs::directory_iterator(kExperiments)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string experiment = entry.path().stem().string();
    INFO(experiment);
    std::string command = command_of(experiment);
    CHECK(command.find(" " + experiment + " ") != std::string::npos);
    CHECK(folder_in(command).rfind("out-", 0) == 0);
    // All but the folder is looked at first.
    command.replace(command.rfind(" -o "), std::string::npos, " -o none/out");
    check_failure(run_program(command, folder.path().string()), 1,
                  "none/out: cannot write: there is no folder");
    ++files;
  }
  CHECK(files == 5);
}

TEST_CASE("experiments: step counts 3 to 15 of S4, out of one tree that grows", "[slow]") {
  const Table rows = sweep_of("experiment-steps");
  REQUIRE(rows.size() == 13);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    CHECK(std::stod(rows[i].at("height")) > std::stod(rows[i - 1].at("height")));
    CHECK(std::stod(rows[i].at("internodes")) > std::stod(rows[i - 1].at("internodes")));
  }
  CHECK(mean_of(rows, {{"steps", "7"}}, "internodes") == 345);
  CHECK(mean_of(rows, {{"steps", "5"}}, "max_order") == 1);
  CHECK(mean_of(rows, {{"steps", "6"}}, "max_order") == 2);
  CHECK(mean_of(rows, {{"steps", "9"}}, "max_order") == 3);
}

TEST_CASE("experiments: the map of direction weights has the report's figures for cells", "[slow]") {
  const Table rows = sweep_of("experiment-directions");
  REQUIRE(rows.size() == 25);
  const std::string optimal = "growth.w_optimal";
  const std::string up = "growth.tropism.up.weight";
  const std::map<std::string, Cells> figures = {{"s4-fig3", {{optimal, "0"}, {up, "0"}}},
                                                {"s4-fig5", {{optimal, "0.5"}, {up, "0"}}},
                                                {"s4-fig6", {{optimal, "0.5"}, {up, "0.3"}}}};
  for (const auto& [preset, cells] : figures) {
    const Table alone = table_of(run_program("stats " + preset + " --csv").out);
    for (const std::string metric : {"internodes", "height", "branching_angle_mean"}) {
      CHECK(mean_of(rows, cells, metric) == Approx(std::stod(alone.at(0).at(metric))));
    }
  }
  for (const std::string w : {"0", "0.5", "1", "2", "4"}) {
    double last = 60.0;
    for (const std::string tropism : {"0", "0.15", "0.3", "0.6", "1.2"}) {
      const double angle = mean_of(rows, {{optimal, w}, {up, tropism}}, "branching_angle_mean");
      CHECK(angle < last);
      last = angle;
    }
  }
  CHECK(mean_of(rows, {{optimal, "0"}, {up, "1.2"}}, "branching_angle_mean") == Approx(20).margin(1));
}

TEST_CASE("experiments: beyond lambda 0.5 the stem takes over", "[slow]") {
  const Table rows = sweep_of("experiment-lambda");
  REQUIRE(rows.size() == 20);
  const std::string key = "growth.lambda";
  for (const std::string bush : {"0.46", "0.48", "0.5"}) {
    const double height = mean_of(rows, {{key, bush}}, "height");
    CHECK(height > 4);
    CHECK(height < 5);
  }
  CHECK(mean_of(rows, {{key, "0.52"}}, "height") == Approx(7).margin(0.5));
  CHECK(mean_of(rows, {{key, "0.54"}}, "height") == Approx(11).margin(0.5));
}

TEST_CASE("experiments: crooks are stronger with larger turns and shorter distances", "[slow]") {
  const Table rows = sweep_of("experiment-crooks");
  REQUIRE(rows.size() == 27);
  const auto tortuosity = [&](const std::string& d, const std::string& alpha) {
    return mean_of(rows, {{"pathplan.levels.1.guiding.d", d}, {"pathplan.levels.1.guiding.alpha_deg", alpha}},
                   "tortuosity_mean");
  };
  for (const std::string d : {"5", "10", "15"}) {
    CHECK(tortuosity(d, "30") < tortuosity(d, "60"));
    CHECK(tortuosity(d, "60") < tortuosity(d, "90"));
  }
  for (const std::string alpha : {"30", "60", "90"}) {
    CHECK(tortuosity("5", alpha) > tortuosity("10", alpha));
    CHECK(tortuosity("10", alpha) > tortuosity("15", alpha));
  }
}

TEST_CASE("experiments: a planned tree as large as a grown one is more crooked", "[slow]") {
  const Folder folder;
  const std::string command = command_of("experiment-methods");
  const Outcome outcome = run_program(command + " --quiet --json", folder.path().string());
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const nlohmann::json told = nlohmann::json::parse(outcome.out);
  for (const auto& distance : told["distances"]) CHECK(distance["between_over_within"] > 3);

  const Table trees = table_of(read_file(folder.path() / folder_in(command) / "metrics.csv"));
  REQUIRE(trees.size() == 16);
  const auto ratio = [&](const std::string& metric) {
    return mean_of(trees, {{"input", "xm12-table1-207k"}}, metric) /
           mean_of(trees, {{"input", "experiment-methods"}}, metric);
  };
  CHECK(ratio("tortuosity_mean") == Approx(1.25).margin(0.03));
  for (const std::string metric : {"height", "crown_radius", "internodes"}) {
    INFO(metric);
    CHECK(ratio(metric) == Approx(1).margin(0.12));
  }
}
