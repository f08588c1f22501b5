// Arrays of many megabytes that are filled in place.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace ramify {

/// Memory in large pages where the system has them: the first touch of a fresh page costs more than all that
/// is written to it. Freed by free_bulk(). Throws std::bad_alloc.
void* allocate_bulk(std::size_t bytes);
void free_bulk(void* memory);

/// Constructs like any allocator, but for what resize() adds: that is left as it is, to be written by whoever
/// asked for it.
struct LeavesUnwritten {
  template <class U>
  void construct(U*) {
    static_assert(std::is_trivially_copyable_v<U>);
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }
};

template <class T>
struct BulkAllocator : LeavesUnwritten {
  using value_type = T;

  BulkAllocator() = default;
  template <class U>
  BulkAllocator(const BulkAllocator<U>&) {}

  T* allocate(std::size_t count) { return static_cast<T*>(allocate_bulk(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t) { free_bulk(memory); }

  friend bool operator==(const BulkAllocator&, const BulkAllocator&) { return true; }
};

/// A vector in memory of allocate_bulk(), whose resize(n) does not write the new elements.
template <class T>
using BulkVector = std::vector<T, BulkAllocator<T>>;

/// Makes it larger; as many elements as could have been added before can be added after that, too, without
/// moving all of them. Memory that is not touched costs nothing.
template <class T>
void resize_with_spare(BulkVector<T>& vector, std::size_t count) {
  vector.reserve(count + (vector.capacity() - vector.size()));
  vector.resize(count);
}

}  // namespace ramify
