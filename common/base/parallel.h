// Loops over many threads. Each index writes its own slot, so the result does not depend on their number.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>

namespace ramify {

/// Calls body(begin, end) for ranges that together cover 0 .. count - 1 once, on several threads.
/// `grain` is about the smallest range worth a task.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

/// Does things of which none needs another.
template <class... Things>
void side_by_side(const Things&... things) {
  const std::array<std::function<void()>, sizeof...(things)> all{std::cref(things)...};
  parallel_for(all.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) all[i]();
  });
}

/// While alive, parallel_for() uses at most `threads` threads; 0 means all cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace ramify
