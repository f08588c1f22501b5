#include "common/base/bulk.h"

#include <cstdlib>

#include "common/base/large_pages.h"

namespace ramify {

void* allocate_bulk(std::size_t bytes) {
  // Only where all of a page is asked for: the rest of the last one stays in small pages, and nothing is
  // wasted.
  const std::size_t in_large_pages = bytes / kLargePage * kLargePage;
  void* memory = nullptr;
  if (in_large_pages == 0) {
    memory = std::malloc(bytes);
  } else if (posix_memalign(&memory, kLargePage, bytes) == 0) {
    prefer_large_pages(memory, in_large_pages);
  }
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void free_bulk(void* memory) {
  std::free(memory);
}

}  // namespace ramify
