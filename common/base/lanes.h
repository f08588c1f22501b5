// Four floats at a time, in one instruction where the machine has such.
#pragma once

#include <array>
#include <bit>
#include <cmath>
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

inline void store(const Lanes& lanes, float* values) {
  std::memcpy(values, &lanes, sizeof lanes);
}

inline void store(const LaneNumbers& lanes, std::uint32_t* values) {
  std::memcpy(values, &lanes, sizeof lanes);
}

inline Lanes all_lanes(float value) {
  return Lanes{value, value, value, value};
}

inline Lanes magnitude(const Lanes& values) {
  constexpr std::int32_t kAllButSign = 0x7fffffff;
  return reinterpret_cast<Lanes>(reinterpret_cast<LaneMask>(values) & kAllButSign);
}

/// Lane by lane.
inline Lanes lesser(const Lanes& a, const Lanes& b) {
  return a < b ? a : b;
}
inline Lanes greater(const Lanes& a, const Lanes& b) {
  return a > b ? a : b;
}

/// Of values that are not negative.
inline Lanes square_root(const Lanes& values) {
#ifdef __SSSE3__
  return reinterpret_cast<Lanes>(_mm_sqrt_ps(reinterpret_cast<__m128>(values)));
#else
  Lanes roots;
  for (std::size_t k = 0; k < kLanes; ++k) roots[k] = std::sqrt(values[k]);
  return roots;
#endif
}

/// Without their fractions, which are lost; of values that fit.
inline LaneMask whole(const Lanes& values) {
  return __builtin_convertvector(values, LaneMask);
}
inline Lanes as_lanes(const LaneMask& values) {
  return __builtin_convertvector(values, Lanes);
}

/// One bit a lane, the first lane's lowest: whether it is set, or negative.
inline unsigned sign_bits(const LaneMask& values) {
#ifdef __SSSE3__
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(values)));
#else
  unsigned bits = 0;
  for (unsigned k = 0; k < kLanes; ++k) bits |= static_cast<std::uint32_t>(values[k]) >> 31 << k;
  return bits;
#endif
}

/// Of four vectors, their first elements, their second ones and so on.
inline std::array<Lanes, 4> transposed(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d) {
  const Lanes ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  const Lanes ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Lanes cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const Lanes cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return {__builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5),
          __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7),
          __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5),
          __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7)};
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
  const unsigned set = sign_bits(is_set);
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
