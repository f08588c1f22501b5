#include "bench/results.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>

#include "bench/machine.h"

namespace ramify::bench {
namespace {

// Seconds by CPU seconds of one thread on an idle machine stay below.
constexpr double kBusy = 1.05;

/// Without means and deviations: the quickest run is what counts.
class LineReporter : public benchmark::ConsoleReporter {
 public:
  LineReporter() : ConsoleReporter(OO_Tabular) {}

  void ReportRuns(const std::vector<Run>& runs) override {
    const bool are_single = !runs.empty() && runs.front().run_type == Run::RT_Iteration;
    if (are_single) benchmark::ConsoleReporter::ReportRuns(runs);
  }
};

std::string text_of(double value, const std::string& unit) {
  const int digits = value < 10.0 ? 2 : (value < 100.0 ? 1 : 0);
  return fmt::format("{:.{}f}{}", value, digits, unit);
}

bool is_met(double value, double bound, const Goal& goal) {
  return goal.is_limit ? value <= bound : value >= bound;
}

std::string verdict_of(double value, const Goal& goal) {
  if (goal.stretch > 0.0 && is_met(value, goal.stretch, goal)) return "stretch";
  return is_met(value, goal.reach, goal) ? "yes" : "NO";
}

}  // namespace

void Results::add(const std::string& name, const Outcome& outcome) {
  const auto [place, is_new] = best_.emplace(name, outcome);
  if (!is_new && outcome.seconds < place->second.seconds) place->second = outcome;
}

std::optional<Outcome> Results::find(const std::string& name) const {
  const auto found = best_.find(name);
  return found == best_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<double> Results::ratio(const std::string& slow, const std::string& quick) const {
  const std::optional<Outcome> a = find(slow);
  const std::optional<Outcome> b = find(quick);
  return a && b ? std::optional(a->seconds / b->seconds) : std::nullopt;
}

std::optional<double> Results::ratio_each(const std::string& slow, const std::string& quick) const {
  const std::optional<Outcome> a = find(slow);
  const std::optional<Outcome> b = find(quick);
  if (!a || !b) return std::nullopt;
  return (a->seconds / a->count) / (b->seconds / b->count);
}

void register_work(Results& results, const std::string& name, int repetitions, std::function<Outcome()> run) {
  const auto body = [&results, name, run = std::move(run)](benchmark::State& state) {
    for (auto iteration : state) {
      static_cast<void>(iteration);
      try {
        const Outcome outcome = run();
        state.SetIterationTime(outcome.seconds);
        if (outcome.count > 0.0) state.counters["count"] = outcome.count;
        if (outcome.peak_bytes > 0.0) state.counters["peak_MB"] = outcome.peak_bytes / 1e6;
        results.add(name, outcome);
      } catch (const std::exception& error) {
        results.fail();
        state.SkipWithError(error.what());
        break;
      }
    }
  };
  benchmark::RegisterBenchmark(name.c_str(), body)
      ->UseManualTime()
      ->Iterations(1)
      ->Repetitions(repetitions)
      ->Unit(benchmark::kMillisecond);
}

void run_registered_work() {
  LineReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
}

Outcome timed(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  Outcome outcome;
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

void GoalTable::add(const std::string& work, std::optional<double> value, const std::string& unit,
                    std::optional<Goal> goal) {
  if (!value) return;
  Row row{work, text_of(*value, unit), "", "", ""};
  if (goal) {
    row.reach = (goal->is_limit ? "<= " : ">= ") + text_of(goal->reach, unit);
    if (goal->stretch > 0.0) row.stretch = text_of(goal->stretch, unit);
    row.verdict = verdict_of(*value, *goal);
  }
  rows_.push_back(row);
}

void GoalTable::add_claim(const std::string& work, std::optional<bool> holds) {
  if (holds) rows_.push_back({work, *holds ? "true" : "false", "true", "", *holds ? "yes" : "NO"});
}

void GoalTable::print() const {
  constexpr const char* layout = "{:<72} {:>10} {:>12} {:>9}  {}\n";
  fmt::print("\n");
  fmt::print(layout, "work", "measured", "reach", "stretch", "ok");
  for (const Row& row : rows_) {
    fmt::print(layout, row.work, row.measured, row.reach, row.stretch, row.verdict);
  }
  print_machine();
}

void print_if_busy(const std::vector<Outcome>& outcomes) {
  double slowdown = 1.0;
  for (const Outcome& outcome : outcomes) {
    slowdown = std::max(slowdown, outcome.seconds / outcome.cpu_seconds);
  }
  if (slowdown < kBusy) return;
  fmt::print("The machine was busy: these runs took up to {:.2f} times their CPU time.\n", slowdown);
}

double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double sum_x = 0.0;
  double sum_y = 0.0;
  double sum_xx = 0.0;
  double sum_xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double log_x = std::log(x[i]);
    const double log_y = std::log(y[i]);
    sum_x += log_x;
    sum_y += log_y;
    sum_xx += log_x * log_x;
    sum_xy += log_x * log_y;
  }
  return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

}  // namespace ramify::bench
