// Seconds by stage, for reports.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramify {

/// Adds up the time between laps under the name of each stage.
class Stopwatch {
 public:
  /// Books the time since the last lap, or since the start, on `stage`.
  void lap(std::string_view stage) {
    const auto now = std::chrono::steady_clock::now();
    const double passed = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    for (auto& [name, seconds] : seconds_) {
      if (name == stage) {
        seconds += passed;
        return;
      }
    }
    seconds_.emplace_back(stage, passed);
  }

  const std::vector<std::pair<std::string, double>>& seconds() const { return seconds_; }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::vector<std::pair<std::string, double>> seconds_;
};

}  // namespace ramify
