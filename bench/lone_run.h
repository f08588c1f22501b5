// Work done in a process of its own: time and memory are of that run alone, whatever ran before it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace ramify::bench {

/// One run, in words that the benchmark itself understands.
struct Trial {
  std::string work;
  int threads = 1;                            // 0: all cores
  std::vector<std::string> assignments = {};  // "KEY=VALUE"
};

struct Outcome {
  double seconds = 0.0;
  double cpu_seconds = 0.0;     // of all threads
  double count = 0.0;           // of what was made: internodes that live, or nodes of all graphs
  double bytes_at_start = 0.0;  // the program itself
  double peak_bytes = 0.0;      // with it
  std::uint64_t skeleton = 0;   // its fingerprint; of a plain version 0
};

/// Time and memory of some work in this process.
Outcome measured(const std::function<void()>& work);

/// Runs this program again with the flag below. Throws RunError if that fails. Linux.
Outcome run_alone(const Trial& trial);

/// The first argument of a process that run_alone() started; the others go to answer_trial().
inline constexpr const char* kLoneRunFlag = "--lone-run";

using Performer = std::function<Outcome(const Trial&)>;

/// Performs the trial that the arguments say and prints the outcome. Returns the exit code.
int answer_trial(std::span<char* const> arguments, const Performer& perform);

}  // namespace ramify::bench
