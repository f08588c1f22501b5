// How much memory processes take and the machine has left.
#pragma once

#include <cstdint>
#include <span>

namespace ramify {

/// Of one process, bytes.
struct ProcessMemory {
  std::uint64_t now = 0;
  std::uint64_t peak = 0;  // the most it ever held
};

/// Of the kernel's own book-keeping (VmRSS, VmHWM), this program's libraries included: what getrusage() says
/// begins with the size of the process that started it. Zeros if there is no such process; 0 is this one.
ProcessMemory process_memory(int process = 0);

/// Gives memory back that only the start of the program needed: the symbol tables of its libraries, which
/// with OpenVDB take 27 MB. What is asked for again comes from the files anew. Linux.
void drop_symbol_tables();

/// What can be taken without swapping (MemAvailable), bytes.
std::uint64_t available_memory();

/// Whether a further process that may come to hold `expected` bytes fits beside those that hold `running`
/// now and may come to as much each, if `available` bytes are left; a tenth is kept free.
bool fits_beside(std::span<const std::uint64_t> running, std::uint64_t expected, std::uint64_t available);

}  // namespace ramify
