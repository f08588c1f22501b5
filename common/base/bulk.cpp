#include "common/base/bulk.h"

#include <cstdlib>

#include "common/base/large_pages.h"

namespace ramify {

void* allocate_bulk(std::size_t bytes) {
  void* memory = nullptr;
  if (bytes < kLargePage) {
    memory = std::malloc(bytes);
  } else if (posix_memalign(&memory, kLargePage, bytes) == 0) {
    prefer_large_pages(memory, bytes);
  }
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void free_bulk(void* memory) {
  std::free(memory);
}

}  // namespace ramify
