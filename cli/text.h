// Numbers as people read them.
#pragma once

#include <cstdint>
#include <string>

namespace ramify::cli {

/// Whole numbers with thousands set apart: "12,345".
inline std::string grouped(std::uint64_t number) {
  const std::string digits = std::to_string(number);
  std::string result;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) result += ',';
    result += digits[i];
  }
  return result;
}

}  // namespace ramify::cli
