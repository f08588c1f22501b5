// What was measured, by name, and how it is told: a table of goals that were reached or not.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/lone_run.h"

namespace ramify::bench {

class Results {
 public:
  /// Keeps the quickest outcome of each name: what else runs on a machine only ever adds time.
  void add(const std::string& name, const Outcome& outcome);
  void fail() { has_failed_ = true; }

  bool has_failed() const { return has_failed_; }

  /// Nothing if it was not run.
  std::optional<Outcome> find(const std::string& name) const;

  /// How many times the seconds of `slow` are those of `quick`; nothing if one of them was not run.
  std::optional<double> ratio(const std::string& slow, const std::string& quick) const;

  /// The same with the seconds for each of what they made.
  std::optional<double> ratio_each(const std::string& slow, const std::string& quick) const;

 private:
  std::map<std::string, Outcome> best_;
  bool has_failed_ = false;
};

/// Hands some work to Google Benchmark, which runs it so many times. What run() returns goes to `results`,
/// which must outlive the benchmarks.
void register_work(Results& results, const std::string& name, int repetitions, std::function<Outcome()> run);

/// Lets Google Benchmark run what is registered and its filter lets through, a line each time.
void run_registered_work();

/// The seconds that `work` takes.
Outcome timed(const std::function<void()>& work);

/// A number to come near to.
struct Goal {
  double reach = 0.0;
  double stretch = 0.0;  // 0: none
  bool is_limit = true;  // at most; else at least
};

/// One line a piece of work: what was measured, and whether the goal was reached.
class GoalTable {
 public:
  /// No line where there is no value. `unit` stands behind each number.
  void add(const std::string& work, std::optional<double> value, const std::string& unit,
           std::optional<Goal> goal = std::nullopt);

  /// A statement that holds or does not.
  void add_claim(const std::string& work, std::optional<bool> holds);

  /// With a line on the machine, which numbers that are no ratios go by.
  void print() const;

 private:
  struct Row {
    std::string work;
    std::string measured;
    std::string reach;
    std::string stretch;
    std::string verdict;
  };
  std::vector<Row> rows_;
};

/// A line if the machine was busy: how much longer than their CPU time these runs took.
void print_if_busy(const std::vector<Outcome>& outcomes);

/// The exponent p of y = c * x^p, by least squares on the logarithms. At least two different x.
double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace ramify::bench
