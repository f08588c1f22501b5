// A queue of nodes by cost for searches whose costs only rise: buckets of equal width in a ring.
// R. B. Dial, Algorithm 360: Shortest-path forest with topological ordering, Communications of the ACM
// 12(11), 1969.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace ramify::pathplan {

/// The order in which nodes are taken out: `rough`, by buckets, those of one bucket in any order (quicker; a
/// node may have to be taken again); or `exact`, by cost, equal costs by the lower number.
enum class QueueOrder { rough, exact };

// A queue needs no more buckets than this: costs that vary very much get wider ones.
inline constexpr double kBucketsMax = 4096.0;

// So many nodes before it is taken, a node had better be made ready: while memory is waited for, about as
// many others are looked at.
inline constexpr std::size_t kSoon = 4;

template <QueueOrder order>
class BucketQueue {
 public:
  struct Entry {
    double cost;
    std::uint32_t node;

    bool operator>(const Entry& other) const {
      return cost > other.cost || (cost == other.cost && node > other.node);
    }
  };

  /// Buckets are `width` wide. What is pushed costs at most `heaviest` more than what was taken last.
  BucketQueue(double width, double heaviest)
      : buckets_per_cost_(1.0 / width),
        buckets_(std::bit_ceil(static_cast<std::size_t>(heaviest / width) + 3)) {}

  void push(double cost, std::uint32_t node) {
    const auto number = static_cast<std::size_t>(cost * buckets_per_cost_);
    if (number > current_) {
      bucket(number).push_back({cost, node});
      ++waiting_;
      return;
    }
    open_.push_back({cost, node});
    if (order == QueueOrder::exact) std::push_heap(open_.begin(), open_.end(), std::greater<>());
  }

  /// Takes out the next node; nothing if none is left. `costs`, by node: those that have become less than
  /// what a node was pushed with make its older entries be passed over.
  std::optional<Entry> pop(std::span<const double> costs) {
    while (true) {
      while (taken_ < open_.size()) {
        const Entry entry = take();
        if (is_valid(entry, costs)) return entry;
      }
      if (waiting_ == 0) return std::nullopt;
      open_next_bucket(costs);
    }
  }

  /// The node that will likely be taken after `ahead` others, to be made ready for that; 0 if none is known.
  std::uint32_t soon(std::size_t ahead) const {
    const std::size_t i = taken_ + ahead;
    return i < open_.size() ? open_[i].node : 0;
  }

 private:
  static bool is_valid(const Entry& entry, std::span<const double> costs) {
    return entry.cost <= costs[entry.node];
  }

  std::vector<Entry>& bucket(std::size_t number) { return buckets_[number & (buckets_.size() - 1)]; }

  Entry take() {
    if (order == QueueOrder::rough) return open_[taken_++];
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    const Entry least = open_.back();
    open_.pop_back();
    return least;
  }

  /// The next one that was pushed to.
  void open_next_bucket(std::span<const double> costs) {
    open_.clear();
    taken_ = 0;
    while (bucket(current_).empty()) ++current_;
    std::swap(open_, bucket(current_));
    waiting_ -= open_.size();
    // Which entries are valid cannot be foreseen: the others are dropped at once, without a branch.
    std::size_t count = 0;
    for (const Entry& entry : open_) {
      open_[count] = entry;
      count += is_valid(entry, costs) ? 1 : 0;
    }
    open_.resize(count);
    if (order == QueueOrder::exact) std::make_heap(open_.begin(), open_.end(), std::greater<>());
  }

  double buckets_per_cost_;
  std::vector<std::vector<Entry>> buckets_;
  std::size_t waiting_ = 0;  // entries in them
  std::size_t current_ = 0;  // the number of the bucket that is open
  std::vector<Entry> open_;  // what it holds; exact: a heap
  std::size_t taken_ = 0;    // rough: so many of them have been taken
};

}  // namespace ramify::pathplan
