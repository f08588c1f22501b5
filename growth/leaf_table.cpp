#include "growth/leaf_table.h"

namespace ramify::growth {
namespace {

// The table takes 4 bytes a leaf of its box, in shadow or not: at most 32 MB.
constexpr double kMaxTableSize = 1 << 23;

}  // namespace

std::uint32_t LeafTable::find_outside(const Coord& leaf) const {
  if (outside_.empty()) return 0;
  const auto found = outside_.find(leaf);
  return found == outside_.end() ? 0 : found->second;
}

std::uint32_t LeafTable::add(const Coord& leaf, Shadow* buffer) {
  const std::uint32_t number = count();
  buffers_.push_back(buffer);
  leaves_.push_back(leaf);
  const std::size_t index = index_of(leaf);
  (index != kOutside ? numbers_[index] : outside_[leaf]) = number;
  return number;
}

void LeafTable::reserve(const Coord& first, const Coord& last) {
  if (index_of(first) != kOutside && index_of(last) != kOutside) return;
  const bool is_empty = numbers_.empty();
  const Coord tight_low = is_empty ? first : glm::min(low_, first);
  const Coord tight_size = (is_empty ? last : glm::max(low_ + size_ - 1, last)) - tight_low + 1;
  const Coord margin = tight_size / 8 + 1;
  const Coord new_size = tight_size + 2 * margin;
  const double volume = double(new_size.x) * double(new_size.y) * double(new_size.z);
  if (volume > kMaxTableSize) return;
  low_ = tight_low - margin;
  size_ = new_size;
  numbers_.assign(static_cast<std::size_t>(volume), 0);
  outside_.clear();
  for (std::uint32_t number = 1; number < count(); ++number) {
    const std::size_t index = index_of(leaves_[number]);
    (index != kOutside ? numbers_[index] : outside_[leaves_[number]]) = number;
  }
}

}  // namespace ramify::growth
