// Path planning measured: whole trees, each in a process of its own, in all sizes, and the parts of planning
// against what libraries offer. What the lines mean: README.md.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "bench/graph_sizes.h"
#include "bench/lone_run.h"
#include "bench/planned_trees.h"
#include "bench/program.h"
#include "bench/results.h"
#include "bench/searches.h"

namespace ramify::bench {
namespace {

constexpr const char* kUsage =
    "Usage: bench_pathplan [--quick] [--check] [--benchmark_...]\n"
    "Measures pathplan/ and compares it with what a kd-tree and a graph library make of the same nodes.\n"
    "  --quick   under 10 s: no graph of more than 100,000 nodes\n"
    "  --check   only whether the library finds the same costs\n"
    "Google Benchmark's own options, such as --benchmark_filter=REGEX, work too.\n";

struct Options {
  bool is_quick = false;
  bool only_checks = false;
  bool wants_help = false;
};

constexpr int kSizes[] = {10'000, 30'000, 33'000, 100'000, 300'000, 1'000'000};
constexpr int kFigureNodes = 33'000;  // XM12 Fig. 22
constexpr int kQuickNodes = 100'000;
constexpr int kManyNodes = 1'000'000;
constexpr int kRepetitions = 5;

std::string graph_name(int nodes) {
  return fmt::format("graph/nodes:{}", nodes);
}
constexpr const char* kLevels = "levels/threads:1";
constexpr const char* kLevelsTwo = "levels/threads:2";

void register_trees(Results& results, const Options& options) {
  const auto add = [&](const std::string& name, const Trial& trial) {
    register_work(results, name, kRepetitions, [trial] { return run_alone(trial); });
  };
  for (const int nodes : kSizes) {
    if (!options.is_quick || nodes <= kQuickNodes) add(graph_name(nodes), one_graph_trial(nodes));
  }
  add(kLevels, four_level_trial(1));
  add(kLevelsTwo, four_level_trial(2));
}

/// The rows of performance.md that are about path planning.
void print_goals(const Results& results) {
  const std::optional<Outcome> figure = results.find(graph_name(kFigureNodes));
  const std::optional<Outcome> one = results.find(kLevels);
  const std::optional<Outcome> two = results.find(kLevelsTwo);
  GoalTable table;
  if (figure)
    table.add("33,000 nodes, 1,500 endpoints, one graph", 1e3 * figure->seconds, " ms", Goal{60.0, 30.0});
  if (one) {
    table.add("four levels, 351,810 nodes, 34,740 endpoints", one->seconds, " s", Goal{0.35, 0.15});
    table.add("  its peak memory, the program included", one->peak_bytes / 1e6, " MB", Goal{64.0});
    table.add("  of it the program and its libraries, before anything is planned", one->bytes_at_start / 1e6,
              " MB");
  }
  add_searches(table, results);
  table.add("time a node, 1 million nodes against 33,000",
            results.ratio_each(graph_name(kManyNodes), graph_name(kFigureNodes)), "x", Goal{1.2, 1.0});
  table.add("two threads against one, four levels", results.ratio(kLevels, kLevelsTwo), "x",
            Goal{1.5, 1.8, false});
  table.add_claim("  and they make the same skeleton, to the last bit",
                  one && two ? std::optional(one->skeleton == two->skeleton) : std::nullopt);
  table.print();
}

void print_sizes(const Results& results) {
  constexpr const char* layout = "{:>10} {:>9} {:>9} {:>16} {:>12} {:>9}\n";
  std::vector<double> nodes;
  std::vector<double> seconds;
  std::vector<Outcome> outcomes;
  for (const int size : kSizes) {
    const std::optional<Outcome> outcome = results.find(graph_name(size));
    if (!outcome) continue;
    nodes.push_back(outcome->count);
    seconds.push_back(outcome->seconds);
    outcomes.push_back(*outcome);
  }
  if (outcomes.empty()) return;
  fmt::print("\nOne graph, one thread, by size; bytes without the program's own\n");
  fmt::print(layout, "nodes", "seconds", "CPU s", "microseconds each", "bytes each", "peak MB");
  for (const Outcome& outcome : outcomes) {
    const double bytes = outcome.peak_bytes - outcome.bytes_at_start;
    fmt::print(layout, outcome.count, fmt::format("{:.4f}", outcome.seconds),
               fmt::format("{:.4f}", outcome.cpu_seconds),
               fmt::format("{:.3f}", outcome.seconds / outcome.count * 1e6),
               fmt::format("{:.0f}", bytes / outcome.count), fmt::format("{:.0f}", outcome.peak_bytes / 1e6));
  }
  if (outcomes.size() < 2) return;
  fmt::print("time grows as N^{:.2f} (Xu & Mould 2012: linear)\n", fitted_exponent(nodes, seconds));
  print_if_busy(outcomes);
}

/// Takes our own options out of the arguments.
Options parse_options(int& argc, char** argv) {
  return {.is_quick = take_flag(argc, argv, "--quick"),
          .only_checks = take_flag(argc, argv, "--check"),
          .wants_help = take_flag(argc, argv, "--help")};
}

int run(int argc, char** argv) {
  const Options options = parse_options(argc, argv);
  if (options.wants_help) {
    fmt::print("{}", kUsage);
    return 0;
  }
  // Ratios mean something between programs that find the same.
  if (const auto found = plain_cost_difference(kFigureNodes)) {
    fmt::print(stderr, "error: {}\n", *found);
    return 1;
  }
  if (options.only_checks) return 0;

  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Results results;
  std::optional<GraphSizes> sizes;
  register_trees(results, options);
  register_searches(results, options.is_quick);
  register_work(results, "graphs", 1, [&] { return timed([&] { sizes = graph_sizes(kFigureNodes); }); });
  run_registered_work();
  benchmark::Shutdown();
  print_sizes(results);
  if (sizes) print(*sizes);
  print_goals(results);
  return results.has_failed() ? 1 : 0;
}

}  // namespace
}  // namespace ramify::bench

int main(int argc, char** argv) {
  return ramify::bench::run_program(argc, argv, ramify::bench::run, ramify::bench::plan);
}
