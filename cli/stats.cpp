#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/text.h"
#include "common/analysis/metrics.h"
#include "common/analysis/metrics_json.h"
#include "common/base/errors.h"

namespace ramify::cli {
namespace {

struct StatsFlags {
  std::vector<std::string> inputs;
  int at_step = -1;
  bool is_csv = false;
  InputFlags reading;
};

struct Measured {
  std::string input;
  Metrics metrics;
};

void print_json(const std::vector<Measured>& trees) {
  for (const Measured& tree : trees) {
    nlohmann::ordered_json object;
    object["input"] = tree.input;
    object.update(metrics_json(tree.metrics));
    fmt::print("{}\n", object.dump());
  }
}

/// Without by_order, which is a list.
void print_csv(const std::vector<Measured>& trees) {
  fmt::print("input");
  for (const MetricInfo& info : metric_table()) fmt::print(",{}", info.key);
  fmt::print("\n");
  for (const Measured& tree : trees) {
    fmt::print("{}", csv_cell(tree.input));
    for (const MetricInfo& info : metric_table()) {
      const std::optional<double> value = info.value(tree.metrics);
      fmt::print(",{}", value ? fmt::format("{}", *value) : "");
    }
    fmt::print("\n");
  }
}

/// Rows of cells, each column as wide as its widest; the first and the last to the left, the others to the
/// right.
void print_aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) line += "  ";
      const bool is_left = i == 0 || i + 1 == row.size();
      line += is_left ? fmt::format("{:<{}}", row[i], widths[i]) : fmt::format("{:>{}}", row[i], widths[i]);
    }
    fmt::print("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
  }
}

void print_table(const std::vector<Measured>& trees) {
  std::vector<std::vector<std::string>> rows;
  rows.push_back({"metric"});
  for (const Measured& tree : trees) {
    rows.back().push_back(std::filesystem::path(tree.input).filename().string());
  }
  rows.back().insert(rows.back().end(), {"unit", "real trees"});
  for (const MetricInfo& info : metric_table()) {
    rows.push_back({std::string(info.key)});
    for (const Measured& tree : trees) rows.back().push_back(metric_text(info, info.value(tree.metrics)));
    rows.back().insert(rows.back().end(), {std::string(info.unit), std::string(info.reference)});
  }
  print_aligned(rows);
}

void print_orders(const Measured& tree) {
  if (tree.metrics.by_order.empty()) return;
  const auto text = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.4g}", *value) : std::string("-");
  };
  std::vector<std::vector<std::string>> rows = {
      {"order", "axes", "length m", "volume m3", "angle mean", "angle median", "tortuosity", ""}};
  for (const OrderMetrics& own : tree.metrics.by_order) {
    rows.push_back({fmt::format("{}", own.order), grouped(own.axes), text(own.length), text(own.volume),
                    text(own.angle_mean_deg), text(own.angle_median_deg), text(own.tortuosity_mean), ""});
  }
  fmt::print("\n{}, by branch order\n", tree.input);
  print_aligned(rows);
}

void stats(StatsFlags flags, const Session& session) {
  if (flags.is_csv && flags.reading.running.is_json) {
    throw InputError("--csv: not together with --json (one of them)");
  }
  if (flags.at_step >= 0) flags.reading.at_step = static_cast<std::uint32_t>(flags.at_step);
  std::vector<Measured> trees;
  for (const std::string& input : flags.inputs) {
    trees.push_back({input, measure(read_living(input, flags.reading, session))});
    if (session.stop.stop_requested()) throw Interrupted();
  }
  if (flags.reading.running.is_json) return print_json(trees);
  if (flags.is_csv) return print_csv(trees);
  print_table(trees);
  for (const Measured& tree : trees) print_orders(tree);
}

}  // namespace

void add_stats(CLI::App& program, const Session& session) {
  auto flags = std::make_shared<StatsFlags>();
  CLI::App* command = program.add_subcommand("stats", "Measure trees, beside what real trees have");
  command
      ->add_option("input", flags->inputs,
                   "A preset or TOML file, a skeleton file (" + skeleton_endings() +
                       "), or a mesh that ramify made (.glb, .gltf)")
      ->type_name("INPUT")
      ->required();
  command->add_option("--at-step", flags->at_step, "The tree as it was after step K")
      ->type_name("K")
      ->check(CLI::NonNegativeNumber);
  add_up_flag(*command, flags->reading.skeleton);
  command->add_flag("--csv", flags->is_csv, "Print a header and one row an input");
  flags->reading.configuring.add_to(*command);
  flags->reading.running.add_to(*command);
  command->callback([flags, &session] { stats(*flags, session); });
}

}  // namespace ramify::cli
