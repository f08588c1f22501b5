// Bytes as text (RFC 4648, base64), while they stream by.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>

namespace ramify {

class Base64Writer {
 public:
  explicit Base64Writer(std::ostream& out) : out_(out) {}

  void add(const void* bytes, std::size_t count);

  /// Writes what is left of the last three bytes and pads it.
  void finish();

 private:
  std::ostream& out_;
  std::array<std::uint8_t, 3> left_{};  // bytes that do not make three yet
  std::size_t left_count_ = 0;
};

}  // namespace ramify
