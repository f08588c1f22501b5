// Colours as people write them: encoded as sRGB, alpha straight (not multiplied in).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace ramify {

/// Components from 0 to 1.
struct Color {
  float r = 0.0f;
  float g = 0.0f;
  float b = 0.0f;
  float a = 1.0f;

  bool operator==(const Color&) const = default;
};

/// The components as bytes, rounded.
using ColorBytes = std::array<std::uint8_t, 4>;

ColorBytes color_bytes(const Color& color);

/// 0xrrggbb as an opaque colour.
constexpr Color color_of(unsigned rgb) {
  return {static_cast<float>((rgb >> 16) & 0xff) / 255.0f, static_cast<float>((rgb >> 8) & 0xff) / 255.0f,
          static_cast<float>(rgb & 0xff) / 255.0f, 1.0f};
}

/// A component's light, 0 to 1, from its sRGB encoding, and back.
float linear_of(float encoded);
float encoded_of(float linear);

/// "transparent", "#rgb", "#rrggbb", "#rrggbbaa" or one of the names of CSS that color.cpp lists, in upper or
/// lower case; nullopt for anything else.
std::optional<Color> parse_color(std::string_view text);

}  // namespace ramify
