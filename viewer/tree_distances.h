// The distances between the two trees on show, worked out beside the window.
#pragma once

#include <array>
#include <future>
#include <memory>
#include <optional>

#include "viewer/numbers.h"

namespace ramify {

class TreeDistances {
 public:
  using Values = std::array<double, kDistanceCount>;  // as in distance_table()

  /// Takes what is done, and begins anew if these are other trees than the last ones: on a thread of its own,
  /// one pair after the other. Never waits.
  void follow(const std::shared_ptr<const Numbers>& a, const std::shared_ptr<const Numbers>& b);

  /// Of the newest pair that is done; nothing before the first.
  const std::optional<Values>& values() const { return values_; }

  /// Whether there is more to come than values() has.
  bool is_busy() const { return running_.valid(); }

 private:
  std::shared_ptr<const Numbers> a_;  // the last pair that was begun
  std::shared_ptr<const Numbers> b_;
  std::optional<Values> values_;
  std::future<Values> running_;
};

}  // namespace ramify
