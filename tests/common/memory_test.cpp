// What processes hold, and how many more there is room for.

#include "common/base/memory.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <functional>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/base/bulk.h"
#include "common/base/large_pages.h"
#include "common/base/mapped.h"
#include "tests/catch.h"

using namespace ramify;

namespace {
constexpr std::uint64_t kMega = 1'000'000;

/// Whether the system gives large pages to whoever has not asked for them, so for the ends of arrays, too.
bool has_large_pages_unasked() {
  std::ifstream in("/sys/kernel/mm/transparent_hugepage/enabled");
  std::string modes;
  std::getline(in, modes);
  return modes.find("[always]") != std::string::npos;
}

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
/// Pages that are touched for the first time while `work` is done.
long fresh_pages(const std::function<void()>& work) {
  const auto touched = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_minflt;
  };
  const long before = touched();
  work();
  return touched() - before;
}
#endif
}  // namespace

TEST_CASE("memory: a process that takes some holds it, and its peak stays when it is given back") {
  const ProcessMemory before = process_memory();
  CHECK(before.now > kMega);
  CHECK(before.peak >= before.now);
  {
    const std::vector<char> taken(200 * kMega, 1);
    CHECK(process_memory().now > before.now + 190 * kMega);
    CHECK(taken.back() == 1);
  }
  CHECK(process_memory().now < before.now + 100 * kMega);
  CHECK(process_memory().peak > before.now + 190 * kMega);
  CHECK(available_memory() > kMega);
}

TEST_CASE("memory: of a process that is not there nothing is known") {
  const ProcessMemory none = process_memory(0x7fffffff);
  CHECK(none.now == 0);
  CHECK(none.peak == 0);
}

TEST_CASE("memory: a process fits if all of them may grow to what is expected") {
  const auto fits = [](std::vector<std::uint64_t> running, std::uint64_t expected, std::uint64_t available) {
    return fits_beside(running, expected, available);
  };
  CHECK(fits({}, 900, 1000));
  CHECK_FALSE(fits({}, 901, 1000));  // a tenth is kept free
  CHECK(fits({300}, 300, 1000));
  CHECK(fits({100}, 400, 1000));        // 300 more for the one that runs, 400 for the next
  CHECK_FALSE(fits({100}, 501, 1000));  // 401 and 501
  CHECK(fits({0, 0}, 300, 1000));
  CHECK_FALSE(fits({0, 0}, 301, 1000));
  CHECK(fits({800, 900}, 300, 400));  // those that have more already take no further
}

TEST_CASE("memory: symbol tables are dropped, and come back where they are needed") {
  const std::uint64_t before = process_memory().now;
  drop_symbol_tables();
  CHECK(process_memory().now + 10'000'000 < before);  // OpenVDB's alone take more
  // Both look things up in what was dropped.
  CHECK_THROWS_AS(std::stoi("no number"), std::invalid_argument);
  double number = 0.0;
  std::istringstream("1.5") >> number;
  CHECK(number == 1.5);
}

TEST_CASE("memory: large pages are asked for in any array") {
  // Neither end is where a large page begins.
  std::vector<std::uint8_t> values(5 * kLargePage + 12345);
  std::iota(values.begin(), values.end(), std::uint8_t{0});
  prefer_large_pages(values.data(), values.size());
  prefer_large_pages(values.data() + 1, kLargePage / 2);  // holds none
  for (std::size_t i = 0; i < values.size(); ++i) REQUIRE(values[i] == static_cast<std::uint8_t>(i));
}

TEST_CASE("memory: a bulk vector keeps what it has when it grows") {
  BulkVector<std::uint32_t> values{1, 2, 3};
  values.resize(1'000'000);
  values[999'999] = 4;
  values.push_back(5);
  CHECK(values[0] == 1);
  CHECK(values[2] == 3);
  CHECK(values[999'999] == 4);
  CHECK(values.back() == 5);
  CHECK(BulkVector<std::uint32_t>(3, 7) == BulkVector<std::uint32_t>{7, 7, 7});
}

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
TEST_CASE("memory: a heap in large pages keeps what it is given back") {
  // In a process of its own: other tests shall find the heap as they know it.
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    keep_heap_in_large_pages();
    const auto fill = [] {
      const std::vector<std::uint8_t> values(16 * kMega, 7);
      if (values.back() != 7) _exit(2);
    };
    fill();
    _exit(fresh_pages(fill) < 16 ? 0 : 1);
  }
  int status = -1;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(status == 0);
}
#endif

TEST_CASE("memory: what is gathered in a large page stays as it is") {
  std::vector<int> values(3'000'000);
  std::iota(values.begin(), values.end(), 0);
  const int* const middle = &values[values.size() / 2];
  CHECK(large_page_of(middle) > large_page_of(values.data()));
  gather_in_large_page(middle);
  for (std::size_t i = 0; i < values.size(); ++i) REQUIRE(values[i] == static_cast<int>(i));
}

TEST_CASE("memory: arrays as large as a large page begin with one, and hold no more than they fill") {
  constexpr std::size_t size = kLargePage + kLargePage / 2;
  constexpr std::size_t count = 20;
  const std::uint64_t before = process_memory().now;
  std::vector<BulkVector<std::uint8_t>> arrays(count);
  for (std::size_t i = 0; i < count; ++i) {
    arrays[i].resize(size);
    std::ranges::fill(arrays[i], static_cast<std::uint8_t>(i));
    CHECK(reinterpret_cast<std::uintptr_t>(arrays[i].data()) % kLargePage == 0);
  }
  // It would be 10 pages more if their ends were filled up.
  if (!has_large_pages_unasked()) CHECK(process_memory().now < before + count * size + 5 * kLargePage);
  for (std::size_t i = 0; i < count; ++i)
    CHECK(static_cast<std::size_t>(std::ranges::count(arrays[i], static_cast<std::uint8_t>(i))) == size);

  BulkVector<std::uint8_t> small(kLargePage - 1, 7);
  CHECK(std::ranges::count(small, std::uint8_t{7}) == std::ssize(small));
}

TEST_CASE("memory: mapped arrays side by side hold no more than they fill, and keep what they have") {
  constexpr std::size_t size = kLargePage + kLargePage / 2;
  constexpr std::size_t count = 20;
  const std::uint64_t before = process_memory().now;
  std::vector<MappedVector<std::uint8_t>> arrays(count);
  for (std::size_t i = 0; i < count; ++i) {
    arrays[i].reserve(10 * size);  // takes none
    arrays[i] = {1, 2, 3};
    arrays[i].resize(size);
    CHECK(arrays[i][2] == 3);
    std::ranges::fill(arrays[i], static_cast<std::uint8_t>(i));
  }
  // Each has at most one large page more than it fills.
  if (!has_large_pages_unasked()) CHECK(process_memory().now < before + count * (size + kLargePage));
  for (std::size_t i = 0; i < count; ++i)
    CHECK(static_cast<std::size_t>(std::ranges::count(arrays[i], static_cast<std::uint8_t>(i))) == size);

  MappedVector<std::uint32_t> grown(3, 7);
  grown.resize(kLeastMapped);  // from the heap to a mapping
  grown.push_back(8);
  CHECK(grown[2] == 7);
  CHECK(grown.back() == 8);
}
