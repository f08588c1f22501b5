#include "common/base/large_pages.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace ramify {

std::uintptr_t large_page_of(const void* address) {
  return reinterpret_cast<std::uintptr_t>(address) / kLargePage;
}

// Both are advice: nothing depends on them.

void prefer_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = (begin + kLargePage - 1) / kLargePage * kLargePage;
  const std::uintptr_t last = (begin + bytes) / kLargePage * kLargePage;
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#endif
}

void gather_in_large_page([[maybe_unused]] const void* address) {
#ifdef __linux__
  constexpr int kCollapse = 25;  // MADV_COLLAPSE, since Linux 6.1
  madvise(reinterpret_cast<void*>(large_page_of(address) * kLargePage), kLargePage, kCollapse);
#endif
}

}  // namespace ramify
