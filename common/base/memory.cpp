#include "common/base/memory.h"

#include <fstream>
#include <string>

namespace ramify {
namespace {

/// The number after `name` in a file of lines "Name:  123 kB", in bytes; 0 if there is none.
std::uint64_t kernel_number(const std::string& file, const std::string& name) {
  std::ifstream lines(file);
  std::string word;
  while (lines >> word) {
    std::uint64_t kibibytes = 0;
    if (word == name && lines >> kibibytes) return kibibytes * 1024;
  }
  return 0;
}

}  // namespace

ProcessMemory process_memory(int process) {
  const std::string file =
      "/proc/" + (process == 0 ? std::string("self") : std::to_string(process)) + "/status";
  return {kernel_number(file, "VmRSS:"), kernel_number(file, "VmHWM:")};
}

std::uint64_t available_memory() {
  return kernel_number("/proc/meminfo", "MemAvailable:");
}

bool fits_beside(std::span<const std::uint64_t> running, std::uint64_t expected, std::uint64_t available) {
  std::uint64_t needed = expected;
  for (const std::uint64_t held : running) needed += held < expected ? expected - held : 0;
  return needed <= available - available / 10;
}

}  // namespace ramify
