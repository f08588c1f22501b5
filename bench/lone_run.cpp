#include "bench/lone_run.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "bench/plain_growth.h"
#include "bench/trees.h"
#include "common/base/errors.h"
#include "common/base/parallel.h"
#include "growth/engine.h"

namespace ramify::bench {
namespace {

std::string quoted(const std::string& argument) {
  return "'" + argument + "'";
}

std::string command_of(const Trial& trial) {
  std::string command = quoted(std::filesystem::read_symlink("/proc/self/exe").string());
  command += fmt::format(" {} {} {}", kLoneRunFlag, trial.version == Version::plain ? "plain" : "growth",
                         trial.threads);
  for (const std::string& assignment : trial.assignments) command += " " + quoted(assignment);
  return command;
}

/// Most memory this process ever held, bytes. Of the kernel's own book-keeping for this program: what
/// getrusage() says begins with the size of the process that started it.
double peak_bytes() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    double kibibytes = 0.0;
    if (word == "VmHWM:" && status >> kibibytes) return kibibytes * 1024.0;
  }
  throw RunError("/proc/self/status has no line VmHWM");
}

Outcome grow(Version version, const growth::Parameters& parameters) {
  using Clock = std::chrono::steady_clock;
  Outcome outcome;
  outcome.bytes_at_start = peak_bytes();
  const std::clock_t cpu_start = std::clock();
  const Clock::time_point start = Clock::now();
  const auto stop = [&] {
    outcome.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    outcome.cpu_seconds = double(std::clock() - cpu_start) / CLOCKS_PER_SEC;
    outcome.peak_bytes = peak_bytes();
  };
  if (version == Version::plain) {
    PlainTree tree(parameters);
    tree.grow();
    stop();
    outcome.internodes = static_cast<double>(tree.internode_count());
    return outcome;
  }
  const RunResult result = growth::Engine::run(parameters, {});
  stop();
  if (!result.is_complete) throw RunError(result.report.warnings.front());
  outcome.internodes = static_cast<double>(result.skeleton.internode_count());
  outcome.skeleton = fingerprint(result.skeleton);
  return outcome;
}

}  // namespace

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
  text >> outcome.seconds >> outcome.cpu_seconds >> outcome.internodes >> outcome.bytes_at_start >>
      outcome.peak_bytes >> outcome.skeleton;
  if (!text) throw RunError(fmt::format("{}: no outcome", command));
  return outcome;
}

int answer_trial(std::span<char* const> arguments) {
  if (arguments.size() < 2) {
    fmt::print(stderr, "error: {} VERSION THREADS [KEY=VALUE]...\n", kLoneRunFlag);
    return 2;
  }
  const Version version = std::string(arguments[0]) == "plain" ? Version::plain : Version::growth;
  const ThreadLimit limit(std::stoi(arguments[1]));
  const auto rest = arguments.subspan(2);
  const Outcome outcome = grow(version, trial_parameters({rest.begin(), rest.end()}));
  fmt::print("{} {} {} {} {} {}\n", outcome.seconds, outcome.cpu_seconds, outcome.internodes,
             outcome.bytes_at_start, outcome.peak_bytes, outcome.skeleton);
  return 0;
}

}  // namespace ramify::bench
