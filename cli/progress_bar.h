// How far a run is, on stderr: a bar with rate and time left on a terminal, else a line now and then.
#pragma once

#include <chrono>
#include <string>

#include "common/config/engine.h"

namespace ramify::cli {

class ProgressBar {
 public:
  explicit ProgressBar(bool is_quiet);
  ~ProgressBar() { clear(); }

  void show(const Progress& now);

  /// Wipes the bar off the terminal.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool is_quiet_;
  bool is_terminal_;
  bool is_shown_ = false;
  std::string stage_;
  Clock::time_point start_ = Clock::now();        // of the run
  Clock::time_point stage_start_ = Clock::now();  // of the stage
  Clock::time_point last_{};
};

/// "1 h 05 min", "2 min 10 s", "7 s".
std::string duration_text(double seconds);

}  // namespace ramify::cli
