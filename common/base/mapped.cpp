#include "common/base/mapped.h"

#include <cstdlib>
#include <new>

#include "common/base/large_pages.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace ramify {
namespace {

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__)

// Advised about before anything is written to it, a mapping becomes one with those beside it. The heap would
// write its size first.
void* map(std::size_t bytes) {
  void* const memory =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) return nullptr;
  prefer_large_pages(memory, bytes);
  return memory;
}

void unmap(void* memory, std::size_t bytes) {
  munmap(memory, bytes);
}

#else

void* map(std::size_t bytes) {
  return std::malloc(bytes);
}

void unmap(void* memory, std::size_t) {
  std::free(memory);
}

#endif

}  // namespace

void* allocate_mapped(std::size_t bytes) {
  void* const memory = bytes < kLeastMapped ? std::malloc(bytes) : map(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void free_mapped(void* memory, std::size_t bytes) {
  bytes < kLeastMapped ? std::free(memory) : unmap(memory, bytes);
}

}  // namespace ramify
