#include "bench/machine.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdint>
#include <random>
#include <utility>

#include "bench/results.h"
#include "common/base/bulk.h"

namespace ramify::bench {
namespace {

constexpr double kBillion = 1e9;

/// Of the processor, as long as it does an addition a cycle: each waits for the one before.
double gigahertz() {
  constexpr std::uint32_t kAdditions = 100'000'000;
  std::uint32_t sum = 0;
  const Outcome outcome = timed([&] {
    while (sum < kAdditions) {
      ++sum;
      asm volatile("" : "+r"(sum));  // or the compiler would add once
    }
  });
  return kAdditions / outcome.seconds / kBillion;
}

/// To have a line of memory from beyond the caches that a core has to itself: each names the next one.
double line_nanoseconds() {
  struct alignas(64) Line {
    std::uint32_t next;
  };
  constexpr std::uint32_t kLines = 1 << 20;
  constexpr std::uint32_t kSteps = 1 << 20;
  BulkVector<Line> lines(kLines);
  for (std::uint32_t i = 0; i < kLines; ++i) lines[i].next = i;
  // One ring of all lines: Sattolo's shuffle.
  std::minstd_rand random;
  for (std::uint32_t i = kLines - 1; i > 0; --i) std::swap(lines[i].next, lines[random() % i].next);
  std::uint32_t at = 0;
  const Outcome outcome = timed([&] {
    for (std::uint32_t step = 0; step < kSteps; ++step) at = lines[at].next;
    benchmark::DoNotOptimize(at);
  });
  return outcome.seconds / kSteps * kBillion;
}

}  // namespace

void print_machine() {
  fmt::print("This machine, now: {:.2f} GHz by additions, {:.0f} ns a line at random in 64 MB of memory.\n",
             gigahertz(), line_nanoseconds());
}

}  // namespace ramify::bench
