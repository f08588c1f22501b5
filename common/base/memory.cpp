#include "common/base/memory.h"

#ifdef __linux__
#include <link.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

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

#ifdef __linux__
std::span<const ElfW(Phdr)> parts_of(const dl_phdr_info& library) {
  return {library.dlpi_phdr, library.dlpi_phnum};
}

/// Whether addresses were written into constants when it was loaded: those are not in its file.
bool has_altered_constants(const dl_phdr_info& library) {
  for (const ElfW(Phdr) & part : parts_of(library)) {
    if (part.p_type != PT_DYNAMIC) continue;
    for (auto entry = reinterpret_cast<const ElfW(Dyn)*>(library.dlpi_addr + part.p_vaddr);
         entry->d_tag != DT_NULL; ++entry) {
      if (entry->d_tag == DT_TEXTREL) return true;
      if (entry->d_tag == DT_FLAGS && (entry->d_un.d_val & DF_TEXTREL) != 0) return true;
    }
  }
  return false;
}

/// Drops what was loaded of the parts of a library that nobody may write to or run.
int drop_constants(dl_phdr_info* library, std::size_t, void*) {
  static const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  if (has_altered_constants(*library)) return 0;
  for (const ElfW(Phdr) & part : parts_of(*library)) {
    if (part.p_type != PT_LOAD || (part.p_flags & (PF_W | PF_X)) != 0) continue;
    const std::uintptr_t begin = (library->dlpi_addr + part.p_vaddr + page - 1) / page * page;
    const std::uintptr_t end = (library->dlpi_addr + part.p_vaddr + part.p_memsz) / page * page;
    if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_DONTNEED);
  }
  return 0;
}
#endif

}  // namespace

void drop_symbol_tables() {
#ifdef __linux__
  dl_iterate_phdr(drop_constants, nullptr);
#endif
}

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
