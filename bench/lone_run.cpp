#include "bench/lone_run.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "common/base/errors.h"
#include "common/base/large_pages.h"
#include "common/base/memory.h"
#include "common/base/parallel.h"

namespace ramify::bench {
namespace {

std::string quoted(const std::string& argument) {
  return "'" + argument + "'";
}

std::string command_of(const Trial& trial) {
  std::string command = quoted(std::filesystem::read_symlink("/proc/self/exe").string());
  command += fmt::format(" {} {} {}", kLoneRunFlag, trial.work, trial.threads);
  for (const std::string& assignment : trial.assignments) command += " " + quoted(assignment);
  return command;
}

/// What the process held at most until now is forgotten. Linux.
void forget_peak() {
  std::ofstream("/proc/self/clear_refs") << 5;
}

}  // namespace

Outcome measured(const std::function<void()>& work) {
  using Clock = std::chrono::steady_clock;
  Outcome outcome;
  outcome.bytes_at_start = double(process_memory().now);
  const std::clock_t cpu_start = std::clock();
  const Clock::time_point start = Clock::now();
  work();
  outcome.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  outcome.cpu_seconds = double(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  outcome.peak_bytes = double(process_memory().peak);
  return outcome;
}

Outcome run_alone(const Trial& trial) {
  const std::string command = command_of(trial);
  std::string answer(256, '\0');
  {
    const auto close = [](std::FILE* pipe) { pclose(pipe); };
    const std::unique_ptr<std::FILE, decltype(close)> pipe(popen(command.c_str(), "r"), close);
    if (!pipe) throw RunError(fmt::format("cannot start {}", command));
    answer.resize(std::fread(answer.data(), 1, answer.size(), pipe.get()));
  }
  std::istringstream text(answer);
  Outcome outcome;
  text >> outcome.seconds >> outcome.cpu_seconds >> outcome.count >> outcome.bytes_at_start >>
      outcome.peak_bytes >> outcome.skeleton;
  if (!text) throw RunError(fmt::format("{}: no outcome", command));
  return outcome;
}

int answer_trial(std::span<char* const> arguments, const Performer& perform) {
  if (arguments.size() < 2) {
    fmt::print(stderr, "error: {} WORK THREADS [KEY=VALUE]...\n", kLoneRunFlag);
    return 2;
  }
  Trial trial{.work = arguments[0], .threads = std::stoi(arguments[1])};
  for (const char* assignment : arguments.subspan(2)) trial.assignments.emplace_back(assignment);
  drop_symbol_tables();
  keep_heap_in_large_pages();
  forget_peak();  // the loader's
  const ThreadLimit limit(trial.threads);
  const Outcome outcome = perform(trial);
  fmt::print("{} {} {} {} {} {}\n", outcome.seconds, outcome.cpu_seconds, outcome.count,
             outcome.bytes_at_start, outcome.peak_bytes, outcome.skeleton);
  return 0;
}

}  // namespace ramify::bench
