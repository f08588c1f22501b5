// Memory in pages of 2 MB, where the system has such: the processor remembers where some thousands of pages
// are, and small ones add up to a few megabytes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace ramify {

inline constexpr std::size_t kLargePage = std::size_t{2} << 20;  // bytes

/// Which large page an address would be in.
std::uintptr_t large_page_of(const void* address);

/// Asks for large pages where memory that nobody has written to yet is first touched. One that lies across an
/// end is had if it is asked for on both sides.
void prefer_large_pages(const void* memory, std::size_t bytes);

/// Lets the heap have its next 512 MB in large pages and keep all it got: what a program takes and gives back
/// again and again is cleared once. Takes addresses, not memory. For the start of main(); glibc.
void keep_heap_in_large_pages();

/// Asks for the large page around an address, most of it in use, to be held in one piece.
void gather_in_large_page(const void* address);

}  // namespace ramify
