// Growth measured: whole trees, each in a process of its own, against the plain version and in all sizes, and
// the parts of growth. What the lines mean: README.md.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "bench/components.h"
#include "bench/lone_run.h"
#include "bench/program.h"
#include "bench/results.h"
#include "bench/trees.h"

namespace ramify::bench {
namespace {

constexpr const char* kUsage =
    "Usage: bench_growth [--quick] [--ten-million] [--check] [--benchmark_...]\n"
    "Measures growth/ and compares it with the plain version of the model.\n"
    "  --quick        under 30 s: no tree of more than 160,000 internodes\n"
    "  --ten-million  also a tree of 10 million internodes\n"
    "  --check        only whether the plain version makes the same trees\n"
    "Google Benchmark's own options, such as --benchmark_filter=REGEX, work too.\n";

struct Options {
  bool is_quick = false;
  bool has_ten_million = false;
  bool only_checks = false;
  bool wants_help = false;
};

// Steps after which the tree has about so many internodes.
constexpr int kQuickSteps = 47;           // 160,000
constexpr int kMediumSteps = 40;          // 98,000
constexpr int kFullSteps = 72;            // 640,000
constexpr int kTenMillionSteps = 180;     // 10 million
constexpr int kPriorityMediumSteps = 21;  // as kMediumSteps
constexpr int kPriorityFullSteps = 30;    // as kFullSteps

// The trees that time is fitted to. In thousands: 40, 80, 98, 160, 320, 463, 640, 968, 1300.
constexpr int kSizes[] = {30, 37, kMediumSteps, kQuickSteps, 59, 66, kFullSteps, 83, 91};

/// A tree such as the quickest public program grows, after as many steps as that takes to the same size.
struct Unshed {
  int steps = 0;
  const char* size = "";
  double public_millions = 0.0;  // internodes a second that the program made; 0: not known
};

constexpr Unshed kUnshed[] = {{30, "153,000"}, {41, "440,000", 0.42}, {52, "975,000", 0.33}};

std::string steps_assignment(int steps) {
  return fmt::format("steps={}", steps);
}

std::string size_name(int steps) {
  return fmt::format("growth/steps:{}", steps);
}
std::string threads_name(int steps) {
  return size_name(steps) + "/threads:2";
}
std::string plain_name(int steps) {
  return fmt::format("plain/steps:{}", steps);
}
std::string unshed_name(int steps) {
  return fmt::format("unshed/steps:{}", steps);
}
std::string dense_name(int steps) {
  return fmt::format("dense/steps:{}", steps);
}
std::string priority_name(int steps) {
  return fmt::format("priority/steps:{}", steps);
}
constexpr const char* kSpace = "space/steps:40";
constexpr const char* kTenMillion = "growth/ten-million";

void register_trial(Results& results, const std::string& name, int repetitions, const Trial& trial) {
  register_work(results, name, repetitions, [trial] { return run_alone(trial); });
}

/// P09's rho and r; about as many internodes as the light model makes in the same steps.
std::vector<std::string> space_assignments() {
  return {steps_assignment(kMediumSteps),
          "growth.environment=space",
          "growth.rho=2",
          "growth.r=5",
          "growth.markers.volume.center=[0,7,0]",
          "growth.markers.volume.radius=7.5",
          "growth.markers.density=500"};
}

int largest_steps(const Options& options) {
  return options.is_quick ? kMediumSteps : kFullSteps;
}

/// For a tree as large.
int priority_steps(const Options& options) {
  return options.is_quick ? kPriorityMediumSteps : kPriorityFullSteps;
}

void register_trees(Results& results, const Options& options) {
  const int repetitions = options.is_quick ? 2 : 3;
  const int many = options.is_quick ? 2 : 7;  // for ratios that hardly differ from their goals
  const auto add = [&](const std::string& name, int steps, Trial trial) {
    const bool is_compared = trial.work == kGrowth && (steps == kMediumSteps || steps == kFullSteps);
    trial.assignments.insert(trial.assignments.begin(), steps_assignment(steps));
    register_trial(results, name, is_compared ? many : repetitions, trial);
  };
  for (const int steps : kSizes) {
    if (options.is_quick && steps > kQuickSteps) continue;
    add(size_name(steps), steps, {.work = kGrowth});
    if (steps != largest_steps(options)) continue;
    add(threads_name(steps), steps, {.work = kGrowth, .threads = 2});
  }
  for (const Unshed& tree : kUnshed) {
    if (options.is_quick == (tree.public_millions > 0.0)) continue;
    const std::vector<std::string> assignments = unshed_assignments(tree.steps);
    register_trial(results, unshed_name(tree.steps), repetitions,
                   {.work = kGrowth, .assignments = assignments});
    register_trial(results, dense_name(tree.steps), repetitions,
                   {.work = kDense, .assignments = assignments});
  }
  const std::vector<std::string> priority = {"growth.allocation=priority"};
  add(priority_name(priority_steps(options)), priority_steps(options),
      {.work = kGrowth, .assignments = priority});
  register_trial(results, kSpace, many, {.work = kGrowth, .assignments = space_assignments()});

  add(plain_name(kMediumSteps), kMediumSteps, {.work = kPlain});
  const Trial plain{.work = kPlain, .assignments = {steps_assignment(kFullSteps)}};
  if (!options.is_quick) register_trial(results, plain_name(kFullSteps), 1, plain);
  if (options.has_ten_million) {
    const Trial trial{.work = kGrowth,
                      .threads = 2,
                      .assignments = {steps_assignment(kTenMillionSteps), "growth.max_internodes=20000000"}};
    register_trial(results, kTenMillion, 1, trial);
  }
}

std::optional<double> seconds_of(const std::optional<Outcome>& outcome) {
  return outcome ? std::optional(outcome->seconds) : std::nullopt;
}

std::optional<double> peak_megabytes_of(const std::optional<Outcome>& outcome) {
  return outcome ? std::optional(outcome->peak_bytes / 1e6) : std::nullopt;
}

std::optional<double> program_megabytes_of(const std::optional<Outcome>& outcome) {
  return outcome ? std::optional(outcome->bytes_at_start / 1e6) : std::nullopt;
}

/// Against the quickest public program: its way, gone by ourselves, and what it was measured to reach.
void add_unshed(GoalTable& table, const Results& results) {
  for (const Unshed& tree : kUnshed) {
    const std::optional<Outcome> grown = results.find(unshed_name(tree.steps));
    if (!grown) continue;
    const bool has_goal = tree.public_millions > 0.0;
    table.add(fmt::format("nothing shed, {}: a dense field and nodes on the heap", tree.size),
              results.ratio(dense_name(tree.steps), unshed_name(tree.steps)), "x",
              has_goal ? std::optional(Goal{2.0, 0.0, false}) : std::nullopt);
    if (!has_goal) continue;
    table.add(fmt::format("  million internodes a second; a public program: {}", tree.public_millions),
              grown->count / grown->seconds / 1e6, "", Goal{2.0 * tree.public_millions, 0.0, false});
  }
}

/// The rows of performance.md that are about growth.
void print_goals(const Results& results, const Options& options) {
  const int largest = largest_steps(options);
  const std::string one_thread = size_name(largest);
  const std::optional<Outcome> full = results.find(size_name(kFullSteps));
  const std::optional<Outcome> one = results.find(one_thread);
  const std::optional<Outcome> two = results.find(threads_name(largest));
  const std::optional<Outcome> huge = results.find(kTenMillion);
  GoalTable table;
  table.add("growth to 640,000 internodes, one thread", seconds_of(full), " s", Goal{1.0, 0.35});
  table.add("  its peak memory, the program included", peak_megabytes_of(full), " MB", Goal{130.0});
  table.add("  of it the program and its libraries, before anything grows", program_megabytes_of(full),
            " MB");
  table.add("  two threads", seconds_of(results.find(threads_name(kFullSteps))), " s");
  table.add("the plain version against it", results.ratio(plain_name(kFullSteps), size_name(kFullSteps)), "x",
            Goal{7.0, 18.0, false});
  table.add("the plain version at 98,000 internodes",
            results.ratio(plain_name(kMediumSteps), size_name(kMediumSteps)), "x");
  add_unshed(table, results);
  add_components(table, results);
  table.add("space markers against light, an internode, 100,000",
            results.ratio_each(kSpace, size_name(kMediumSteps)), "x", Goal{3.0, 1.5});
  table.add("priority against Borchert-Honda, an internode of a tree as large",
            results.ratio_each(priority_name(priority_steps(options)), one_thread), "x");
  table.add("two threads against one", results.ratio(one_thread, threads_name(largest)), "x",
            Goal{1.5, 1.8, false});
  table.add_claim("  and they make the same skeleton, to the last bit",
                  one && two ? std::optional(one->skeleton == two->skeleton) : std::nullopt);
  table.add("growth to 10 million internodes, two threads", seconds_of(huge), " s");
  table.add("  its peak memory", peak_megabytes_of(huge), " MB", Goal{2500.0});
  table.print();
}

void print_sizes(const Results& results) {
  constexpr const char* layout = "{:>10} {:>7} {:>9} {:>9} {:>12} {:>12} {:>9}\n";
  std::vector<double> internodes;
  std::vector<double> seconds;
  std::vector<Outcome> outcomes;
  const bool has_any = std::any_of(std::begin(kSizes), std::end(kSizes),
                                   [&](int steps) { return results.find(size_name(steps)).has_value(); });
  if (!has_any) return;
  fmt::print("\nOne thread, by size; bytes without the program's own\n");
  fmt::print(layout, "internodes", "steps", "seconds", "CPU s", "million/s", "bytes each", "peak MB");
  for (const int steps : kSizes) {
    const std::optional<Outcome> outcome = results.find(size_name(steps));
    if (!outcome) continue;
    internodes.push_back(outcome->count);
    seconds.push_back(outcome->seconds);
    outcomes.push_back(*outcome);
    const double bytes = outcome->peak_bytes - outcome->bytes_at_start;
    fmt::print(layout, outcome->count, steps, fmt::format("{:.3f}", outcome->seconds),
               fmt::format("{:.3f}", outcome->cpu_seconds),
               fmt::format("{:.2f}", outcome->count / outcome->seconds / 1e6),
               fmt::format("{:.0f}", bytes / outcome->count),
               fmt::format("{:.0f}", outcome->peak_bytes / 1e6));
  }
  if (internodes.size() < 2) return;
  fmt::print("time grows as N^{:.2f} (reach: N^1.3)\n", fitted_exponent(internodes, seconds));
  print_if_busy(outcomes);
}

/// Takes our own options out of the arguments.
Options parse_options(int& argc, char** argv) {
  return {.is_quick = take_flag(argc, argv, "--quick"),
          .has_ten_million = take_flag(argc, argv, "--ten-million"),
          .only_checks = take_flag(argc, argv, "--check"),
          .wants_help = take_flag(argc, argv, "--help")};
}

int run(int argc, char** argv) {
  const Options options = parse_options(argc, argv);
  if (options.wants_help) {
    fmt::print("{}", kUsage);
    return 0;
  }
  // Ratios mean something between programs that do the same.
  if (const auto found = plain_difference({12, options.only_checks ? 20 : 36})) {
    fmt::print(stderr, "error: {}\n", *found);
    return 1;
  }
  if (options.only_checks) return 0;

  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Results results;
  register_trees(results, options);
  register_components(results, largest_steps(options));
  run_registered_work();
  benchmark::Shutdown();
  print_sizes(results);
  print_goals(results, options);
  return results.has_failed() ? 1 : 0;
}

}  // namespace
}  // namespace ramify::bench

int main(int argc, char** argv) {
  return ramify::bench::run_program(argc, argv, ramify::bench::run, ramify::bench::grow);
}
