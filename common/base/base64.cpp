#include "common/base/base64.h"

#include <algorithm>
#include <ostream>
#include <string>
#include <string_view>

namespace ramify {
namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// The four digits of three bytes.
char* put_digits(char* to, const std::uint8_t* bytes) {
  const unsigned bits = (bytes[0] << 16u) | (bytes[1] << 8u) | bytes[2];
  for (int shift = 18; shift >= 0; shift -= 6) *to++ = kDigits[(bits >> shift) & 63u];
  return to;
}

}  // namespace

void Base64Writer::add(const void* bytes, std::size_t count) {
  const auto* from = static_cast<const std::uint8_t*>(bytes);
  std::array<char, 4096> text;
  char* to = text.data();
  while (count > 0) {
    if (left_count_ == 0 && count >= 3) {
      to = put_digits(to, from);
      from += 3;
      count -= 3;
    } else {
      left_[left_count_++] = *from++;
      --count;
      if (left_count_ == 3) {
        to = put_digits(to, left_.data());
        left_count_ = 0;
      }
    }
    if (to == text.data() + text.size() || count == 0) {
      out_.write(text.data(), to - text.data());
      to = text.data();
    }
  }
}

void Base64Writer::finish() {
  if (left_count_ == 0) return;
  std::fill(left_.begin() + static_cast<std::ptrdiff_t>(left_count_), left_.end(), std::uint8_t{0});
  std::array<char, 4> text;
  put_digits(text.data(), left_.data());
  std::fill(text.begin() + static_cast<std::ptrdiff_t>(left_count_) + 1, text.end(), '=');
  out_.write(text.data(), text.size());
  left_count_ = 0;
}

}  // namespace ramify
