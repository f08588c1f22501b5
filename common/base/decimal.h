// Numbers as text with a fixed precision, for files of many millions of them.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace ramify {

namespace decimal {

// "00" to "99": two digits come out of one division.
inline constexpr std::array<char, 200> kPairs = [] {
  std::array<char, 200> pairs{};
  for (int i = 0; i < 100; ++i) {
    pairs[2 * i] = static_cast<char>('0' + i / 10);
    pairs[2 * i + 1] = static_cast<char>('0' + i % 10);
  }
  return pairs;
}();

/// Room for the longest number that append_decimal() and append_whole() write.
inline constexpr std::size_t kMaxLength = 20;

}  // namespace decimal

/// Writes `value` in decimal at `to`; returns where it ends.
inline char* append_whole(char* to, std::uint64_t value) {
  std::array<char, 20> digits;
  char* first = digits.data() + digits.size();
  while (value >= 100) {
    first -= 2;
    std::memcpy(first, &decimal::kPairs[2 * (value % 100)], 2);
    value /= 100;
  }
  if (value >= 10) {
    first -= 2;
    std::memcpy(first, &decimal::kPairs[2 * value], 2);
  } else {
    *--first = static_cast<char>('0' + value);
  }
  const auto length = static_cast<std::size_t>(digits.data() + digits.size() - first);
  std::memcpy(to, first, length);
  return to + length;
}

/// Writes `value` rounded to `Places` (an even number of) decimal places, without zeros at their end:
/// "-0.25", "3". Numbers beyond 1e9 and those that are not finite are written as std::to_chars writes them.
template <int Places>
char* append_decimal(char* to, float value) {
  static_assert(Places > 0 && Places <= 8 && Places % 2 == 0);
  if (!(std::abs(value) < 1e9f)) return std::to_chars(to, to + decimal::kMaxLength, value).ptr;
  constexpr std::uint64_t kScale = [] {
    std::uint64_t scale = 1;
    for (int i = 0; i < Places; ++i) scale *= 10;
    return scale;
  }();
  const double magnitude = std::abs(static_cast<double>(value)) * static_cast<double>(kScale) + 0.5;
  const auto scaled = static_cast<std::uint64_t>(magnitude);
  if (value < 0.0f && scaled > 0) *to++ = '-';
  to = append_whole(to, scaled / kScale);
  std::uint64_t fraction = scaled % kScale;
  if (fraction == 0) return to;
  *to++ = '.';
  for (int place = Places - 2; place >= 0; place -= 2) {
    std::memcpy(to + place, &decimal::kPairs[2 * (fraction % 100)], 2);
    fraction /= 100;
  }
  to += Places;
  while (to[-1] == '0') --to;
  return to;
}

}  // namespace ramify
