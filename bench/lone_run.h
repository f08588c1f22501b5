// A tree grown in a process of its own: time and memory are of that run alone, whatever ran before it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace ramify::bench {

enum class Version { growth, plain };

struct Trial {
  Version version = Version::growth;
  int threads = 1;                            // 0: all cores
  std::vector<std::string> assignments = {};  // "KEY=VALUE", over the tree of 640,000 internodes
};

struct Outcome {
  double seconds = 0.0;
  double cpu_seconds = 0.0;     // of all threads
  double internodes = 0.0;      // living
  double bytes_at_start = 0.0;  // the program itself
  double peak_bytes = 0.0;      // with it
  std::uint64_t skeleton = 0;   // its fingerprint; of the plain version 0
};

/// Runs this program again with the flag below. Throws RunError if that fails. Linux.
Outcome run_alone(const Trial& trial);

/// The first argument of a process that run_alone() started; the others go to answer_trial().
inline constexpr const char* kLoneRunFlag = "--lone-run";

/// Grows the tree that the arguments say and prints the outcome. Returns the exit code.
int answer_trial(std::span<char* const> arguments);

}  // namespace ramify::bench
