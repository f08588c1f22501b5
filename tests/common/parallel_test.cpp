#include "common/base/parallel.h"

#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "tests/catch.h"

using namespace ramify;

namespace {

/// How many threads take part in a loop whose tasks all take a while.
std::size_t threads_used() {
  std::mutex mutex;
  std::set<std::thread::id> seen;
  parallel_for(64, 1, [&](std::size_t, std::size_t) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const std::lock_guard lock(mutex);
    seen.insert(std::this_thread::get_id());
  });
  return seen.size();
}

}  // namespace

TEST_CASE("parallel: every index is visited once") {
  std::vector<int> visits(1000, 0);
  parallel_for(visits.size(), 7, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ++visits[i];
  });
  CHECK(visits == std::vector<int>(1000, 1));
  parallel_for(0, 1, [&](std::size_t, std::size_t) { FAIL("nothing to do"); });
}

TEST_CASE("parallel: things side by side are each done once, on one thread in their order") {
  std::vector<int> done;
  const ThreadLimit limit(1);
  side_by_side([&] { done.push_back(1); }, [&] { done.push_back(2); }, [&] { done.push_back(3); });
  CHECK(done == std::vector<int>{1, 2, 3});
}

TEST_CASE("parallel: a limit of one thread is kept, and gone with the limit") {
  if (std::thread::hardware_concurrency() > 1) CHECK(threads_used() > 1);
  {
    const ThreadLimit limit(1);
    CHECK(threads_used() == 1);
  }
  if (std::thread::hardware_concurrency() > 1) CHECK(threads_used() > 1);
}
