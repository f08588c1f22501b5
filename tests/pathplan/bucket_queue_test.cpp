#include "pathplan/bucket_queue.h"

#include <limits>
#include <map>
#include <queue>

#include "common/base/rng.h"
#include "tests/catch.h"

using namespace ramify;
using namespace ramify::pathplan;

namespace {

struct Range {
  double typical;
  double heaviest;

  double width() const { return std::max(0.12 * typical, heaviest / kBucketsMax); }
};

// The last ones have so many costs to a bucket, or so many buckets to a cost, that limits on both matter.
const std::vector<Range> kRanges = {{1.0, 2.0},  {0.01, 0.011}, {1.0, 300.0},
                                    {1e-6, 1e3}, {1e-9, 1e-9},  {50.0, 1.0}};

/// Pushes and pops as a search does: what is pushed costs at most `heaviest` more than what was taken. Some
/// costs are equal. Calls taken(entry) for each entry taken and put(entry) for each put in.
template <class Queue, class Put, class Taken>
void search_with(Queue& queue, const Range& range, std::uint64_t seed, const Put& put, const Taken& taken) {
  Rng rng = Rng::stream(seed, Stream::surplus, 0);
  const auto add = [&](double cost) {
    const auto node = static_cast<std::uint32_t>(rng.below(1000));
    queue.push(cost, node);
    put(typename Queue::Entry{cost, node});
  };
  for (int i = 0; i < 3; ++i) add(0.0);
  int left = 4000;
  const std::vector<double> costs(1000, std::numeric_limits<double>::infinity());  // nothing is passed over
  while (const auto next = queue.pop(costs)) {
    const auto entry = *next;
    taken(entry);
    for (std::uint64_t i = rng.below(4); i > 0 && left > 0; --i, --left) {
      const double step = rng.coin() ? std::min(range.typical, range.heaviest) : range.heaviest;
      add(entry.cost + (rng.below(3) == 0 ? step : step * rng.uniform()));
    }
  }
}

}  // namespace

TEST_CASE("bucket queue: exact, it takes out what a priority queue takes out, ties by the lower number") {
  using Queue = BucketQueue<QueueOrder::exact>;
  for (const Range& range : kRanges) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      INFO("typical " << range.typical << ", heaviest " << range.heaviest << ", seed " << seed);
      Queue queue(range.width(), range.heaviest);
      using Label = std::pair<double, std::uint32_t>;
      std::priority_queue<Label, std::vector<Label>, std::greater<>> expected;
      std::size_t count = 0;
      search_with(
          queue, range, seed, [&](const Queue::Entry& entry) { expected.emplace(entry.cost, entry.node); },
          [&](const Queue::Entry& entry) {
            ++count;
            REQUIRE(entry.cost == expected.top().first);
            REQUIRE(entry.node == expected.top().second);
            expected.pop();
          });
      CHECK(count > 1000);
      CHECK(expected.empty());
    }
  }
}

TEST_CASE("bucket queue: rough, it takes out all that was put in, and nothing more than a bucket late") {
  using Queue = BucketQueue<QueueOrder::rough>;
  for (const Range& range : kRanges) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      INFO("typical " << range.typical << ", heaviest " << range.heaviest << ", seed " << seed);
      const double width = range.width();
      Queue queue(width, range.heaviest);
      std::map<std::pair<double, std::uint32_t>, int> inside;
      double greatest = 0.0;
      std::size_t count = 0;
      search_with(
          queue, range, seed,
          [&](const Queue::Entry& entry) {
            ++inside[{entry.cost, entry.node}];
          },
          [&](const Queue::Entry& entry) {
            ++count;
            REQUIRE(--inside[{entry.cost, entry.node}] >= 0);
            REQUIRE(entry.cost > greatest - width * (1.0 + 1e-9));
            greatest = std::max(greatest, entry.cost);
          });
      CHECK(count > 1000);
      for (const auto& [entry, left] : inside) CHECK(left == 0);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("bucket queue: a node is not taken for more than it costs by then", "",
                       ((QueueOrder order), order), QueueOrder::rough, QueueOrder::exact) {
  BucketQueue<order> queue(1.0, 10.0);
  std::vector<double> costs = {0.0, 4.5, 4.2, 7.0};
  queue.push(0.0, 0);
  queue.push(6.5, 1);  // later than what it costs now
  queue.push(4.5, 1);
  queue.push(4.2, 2);
  queue.push(7.0, 3);
  CHECK(queue.pop(costs)->node == 0);
  const auto next = queue.pop(costs);
  CHECK(next->cost == costs[next->node]);
  const std::uint32_t other = 3 - next->node;
  costs[other] = 4.1;  // made cheaper while its bucket is open
  queue.push(4.1, other);
  CHECK(queue.pop(costs)->cost == 4.1);
  CHECK(queue.pop(costs)->node == 3);
  CHECK_FALSE(queue.pop(costs).has_value());
}
