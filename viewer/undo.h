// What a config's parameters were, and how to get back there.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/config/job.h"

namespace ramify {

/// A line of states with a place in it. The jobs it keeps share their parameters with nobody.
class Undo {
 public:
  explicit Undo(const Job& first) { record(first); }

  /// Puts the state after the present one; what had been undone is forgotten, and of more than a few hundred
  /// states the oldest.
  void record(const Job& job) {
    states_.resize(states_.empty() ? 0 : present_ + 1);
    if (states_.size() == kMostStates) states_.erase(states_.begin());
    states_.push_back(independent_copy(job));
    present_ = states_.size() - 1;
  }

  bool has_earlier() const { return present_ > 0; }
  bool has_later() const { return present_ + 1 < states_.size(); }

  /// A copy of the state before, or after, the present one, which it becomes; nothing at the end of the line.
  std::optional<Job> back() { return has_earlier() ? state(present_ - 1) : std::nullopt; }
  std::optional<Job> forward() { return has_later() ? state(present_ + 1) : std::nullopt; }

 private:
  static constexpr std::size_t kMostStates = 300;

  std::optional<Job> state(std::size_t index) {
    present_ = index;
    return independent_copy(states_[index]);
  }

  std::vector<Job> states_;
  std::size_t present_ = 0;
};

}  // namespace ramify
