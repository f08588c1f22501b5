#include "common/base/bulk.h"

#include <cstdlib>

#include "common/base/large_pages.h"

namespace ramify {
namespace {

// Less than this would waste the better part of its last page.
constexpr std::size_t kBulk = 4 * kLargePage;

}  // namespace

void* allocate_bulk(std::size_t bytes) {
  const bool is_bulk = bytes >= kBulk;
  const std::size_t rounded = (bytes + kLargePage - 1) / kLargePage * kLargePage;
  void* memory = is_bulk ? std::aligned_alloc(kLargePage, rounded) : std::malloc(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  if (is_bulk) prefer_large_pages(memory, rounded);
  return memory;
}

void free_bulk(void* memory) {
  std::free(memory);
}

}  // namespace ramify
