// Where a tree comes from: written into every file that can carry it.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace ramify {

struct Provenance {
  std::string version;  // ramify's
  std::string engine;
  std::uint64_t seed = 0;
  int steps = 0;
  std::string config;  // the complete config as TOML
  /// Those that the tree defines, by key; only where a file carries them.
  std::vector<std::pair<std::string, double>> metrics = {};
};

/// This program's version, "0.1.0".
std::string version();

}  // namespace ramify
