// Arrays that stay and grow: each in a mapping of its own.
#pragma once

#include <cstddef>
#include <vector>

#include "common/base/bulk.h"

namespace ramify {

/// From here on arrays have a mapping of their own; smaller ones are in the heap. Bytes.
inline constexpr std::size_t kLeastMapped = std::size_t{512} << 10;

/// Memory that takes nothing where it is not touched, in large pages if the system has them: also across the
/// ends of mappings that lie side by side, which the heap's own cannot have. Throws std::bad_alloc.
void* allocate_mapped(std::size_t bytes);

/// Gives it back to the system; `bytes` as they were asked for.
void free_mapped(void* memory, std::size_t bytes);

template <class T>
struct MappedAllocator : LeavesUnwritten {
  using value_type = T;

  MappedAllocator() = default;
  template <class U>
  MappedAllocator(const MappedAllocator<U>&) {}

  T* allocate(std::size_t count) { return static_cast<T*>(allocate_mapped(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t count) { free_mapped(memory, count * sizeof(T)); }

  friend bool operator==(const MappedAllocator&, const MappedAllocator&) { return true; }
};

/// A vector with much room, whose resize(n) does not write the new elements. What is short-lived had better
/// be a BulkVector: a mapping is cleared each time.
template <class T>
using MappedVector = std::vector<T, MappedAllocator<T>>;

}  // namespace ramify
