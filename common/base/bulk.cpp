#include "common/base/bulk.h"

#include <cstdlib>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace ramify {
namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20;

// Less than this would waste the better part of its last page.
constexpr std::size_t kBulk = 4 * kLargePage;

}  // namespace

void* allocate_bulk(std::size_t bytes) {
  const bool is_bulk = bytes >= kBulk;
  const std::size_t rounded = (bytes + kLargePage - 1) / kLargePage * kLargePage;
  void* memory = is_bulk ? std::aligned_alloc(kLargePage, rounded) : std::malloc(bytes);
  if (memory == nullptr) throw std::bad_alloc();
#ifdef __linux__
  if (is_bulk) madvise(memory, rounded, MADV_HUGEPAGE);  // advice: nothing depends on it
#endif
  return memory;
}

void free_bulk(void* memory) {
  std::free(memory);
}

}  // namespace ramify
