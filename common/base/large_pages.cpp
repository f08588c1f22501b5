#include "common/base/large_pages.h"

#ifdef __linux__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <limits>
#endif

namespace ramify {

std::uintptr_t large_page_of(const void* address) {
  return reinterpret_cast<std::uintptr_t>(address) / kLargePage;
}

// Both are advice: nothing depends on them.

void prefer_large_pages([[maybe_unused]] const void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const std::uintptr_t first = reinterpret_cast<std::uintptr_t>(memory) / page * page;
  madvise(reinterpret_cast<void*>(first), reinterpret_cast<std::uintptr_t>(memory) + bytes - first,
          MADV_HUGEPAGE);
#endif
}

void gather_in_large_page([[maybe_unused]] const void* address) {
#ifdef __linux__
  constexpr int kCollapse = 25;  // MADV_COLLAPSE, since Linux 6.1
  madvise(reinterpret_cast<void*>(large_page_of(address) * kLargePage), kLargePage, kCollapse);
#endif
}

void keep_heap_in_large_pages() {
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
  constexpr int kRoom = 512 << 20;   // bytes of addresses
  constexpr int kMapped = 32 << 20;  // the most that mallopt() takes
  mallopt(M_MMAP_THRESHOLD, kMapped);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_TOP_PAD, kRoom);
  const auto* const end = static_cast<const std::byte*>(sbrk(0));
  void* const volatile more = std::malloc(kLargePage);  // than there is room for
  std::free(more);
  prefer_large_pages(end, static_cast<std::size_t>(static_cast<const std::byte*>(sbrk(0)) - end));
#endif
}

}  // namespace ramify
