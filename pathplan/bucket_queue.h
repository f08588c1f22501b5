// A queue of nodes by cost for searches whose costs only rise: buckets of equal width in a ring.
// R. B. Dial, Algorithm 360: Shortest-path forest with topological ordering, Communications of the ACM
// 12(11), 1969.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace ramify::pathplan {

/// The order in which nodes are taken out: `rough`, by buckets, those of one bucket in any order (quicker; a
/// node may have to be taken again); or `exact`, by cost, equal costs by the lower number.
enum class QueueOrder { rough, exact };

// A queue needs no more buckets than this: costs that vary very much get wider ones.
inline constexpr double kBucketsMax = 4096.0;

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
        heads_(std::bit_ceil(static_cast<std::size_t>(heaviest / width) + 3), kNone) {}

  bool is_empty() const { return size_ == 0; }

  /// A node that will be taken soon, likely next, to be made ready for that; any at first.
  std::uint32_t soon() const { return soon_; }

  void push(double cost, std::uint32_t node) {
    ++size_;
    const auto bucket = static_cast<std::size_t>(cost * buckets_per_cost_);
    if (order == QueueOrder::exact && bucket <= current_) {
      sorted_.push_back({cost, node});
      std::push_heap(sorted_.begin(), sorted_.end(), std::greater<>());
      return;
    }
    std::uint32_t& head = heads_[bucket & (heads_.size() - 1)];
    if (free_ == kNone) {
      slots_.push_back({cost, node, head});
      head = static_cast<std::uint32_t>(slots_.size() - 1);
    } else {
      const std::uint32_t slot = std::exchange(free_, slots_[free_].next);
      slots_[slot] = {cost, node, head};
      head = slot;
    }
  }

  /// Not when it is empty.
  Entry pop() {
    --size_;
    if constexpr (order == QueueOrder::exact) {
      while (sorted_.empty()) sort_next_bucket();
      std::pop_heap(sorted_.begin(), sorted_.end(), std::greater<>());
      const Entry least = sorted_.back();
      sorted_.pop_back();
      return least;
    } else {
      while (heads_[current_ & (heads_.size() - 1)] == kNone) ++current_;
      return take_first(heads_[current_ & (heads_.size() - 1)]);
    }
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  struct Slot {
    double cost;
    std::uint32_t node;
    std::uint32_t next;  // in its bucket, or among the free ones
  };

  Entry take_first(std::uint32_t& head) {
    const std::uint32_t slot = head;
    const Entry entry{slots_[slot].cost, slots_[slot].node};
    head = std::exchange(slots_[slot].next, free_);
    free_ = slot;
    if (head != kNone) soon_ = slots_[head].node;
    return entry;
  }

  void sort_next_bucket() {
    std::uint32_t* head = &heads_[current_ & (heads_.size() - 1)];
    while (*head == kNone) head = &heads_[++current_ & (heads_.size() - 1)];
    while (*head != kNone) sorted_.push_back(take_first(*head));
    std::make_heap(sorted_.begin(), sorted_.end(), std::greater<>());
  }

  double buckets_per_cost_;
  std::vector<std::uint32_t> heads_;  // of each bucket, its first slot
  std::vector<Slot> slots_;
  std::uint32_t free_ = kNone;  // the first slot that is not in use
  std::size_t current_ = 0;     // the bucket that is being emptied
  std::vector<Entry> sorted_;   // exact: a heap of what it holds
  std::size_t size_ = 0;        // entries
  std::uint32_t soon_ = 0;
};

}  // namespace ramify::pathplan
