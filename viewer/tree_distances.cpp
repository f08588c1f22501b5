#include "viewer/tree_distances.h"

#include <chrono>

namespace ramify {

void TreeDistances::follow(const std::shared_ptr<const Numbers>& a, const std::shared_ptr<const Numbers>& b) {
  if (running_.valid()) {
    if (running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    values_ = running_.get();
  }
  if (!a || !b || (a == a_ && b == b_)) return;
  a_ = a;
  b_ = b;
  running_ = std::async(std::launch::async, [a, b] { return distances_of(a->form, b->form); });
}

}  // namespace ramify
