// Four floats at a time, in one instruction where the machine has such.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#ifdef __SSSE3__
#include <immintrin.h>
#endif

namespace ramify {

inline constexpr std::size_t kLanes = 4;
using Lanes [[gnu::vector_size(kLanes * sizeof(float))]] = float;
using LaneNumbers [[gnu::vector_size(kLanes * sizeof(float))]] = std::uint32_t;
using LaneMask [[gnu::vector_size(kLanes * sizeof(float))]] = std::int32_t;  // -1: set, or 0

inline Lanes load_lanes(const float* values) {
  Lanes lanes;
  std::memcpy(&lanes, values, sizeof lanes);
  return lanes;
}

inline LaneNumbers load_lanes(const std::uint32_t* values) {
  LaneNumbers lanes;
  std::memcpy(&lanes, values, sizeof lanes);
  return lanes;
}

inline Lanes all_lanes(float value) {
  return Lanes{value, value, value, value};
}

inline Lanes magnitude(const Lanes& values) {
  constexpr std::int32_t kAllButSign = 0x7fffffff;
  return reinterpret_cast<Lanes>(reinterpret_cast<LaneMask>(values) & kAllButSign);
}

/// Writes those of four numbers whose lanes are set, one after the other, and returns how many; behind them
/// as many are overwritten as are not set. Without a branch, which could not be foreseen.
inline std::size_t pack(const LaneNumbers& numbers, const LaneMask& is_set, std::uint32_t* packed) {
#ifdef __SSSE3__
  static constexpr auto kShuffles = [] {
    std::array<std::array<std::uint8_t, 16>, 16> shuffles{};
    for (unsigned set = 0; set < 16; ++set) {
      unsigned to = 0;
      for (unsigned lane = 0; lane < kLanes; ++lane) {
        if ((set >> lane & 1) == 0) continue;
        for (unsigned byte = 0; byte < 4; ++byte)
          shuffles[set][to++] = static_cast<std::uint8_t>(4 * lane + byte);
      }
    }
    return shuffles;
  }();
  const auto set = static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(is_set)));
  const __m128i shuffle = _mm_loadu_si128(reinterpret_cast<const __m128i*>(kShuffles[set].data()));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(packed),
                   _mm_shuffle_epi8(reinterpret_cast<__m128i>(numbers), shuffle));
  return static_cast<std::size_t>(std::popcount(set));
#else
  std::size_t count = 0;
  for (std::size_t k = 0; k < kLanes; ++k) {
    packed[count] = numbers[k];
    count += static_cast<std::size_t>(is_set[k] & 1);
  }
  return count;
#endif
}

}  // namespace ramify
