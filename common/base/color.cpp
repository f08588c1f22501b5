#include "common/base/color.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

namespace ramify {
namespace {

constexpr auto kNamedColors = std::to_array<std::pair<std::string_view, unsigned>>({
    {"beige", 0xf5f5dc},     {"black", 0x000000},     {"blue", 0x0000ff},       {"brown", 0xa52a2a},
    {"darkgray", 0xa9a9a9},  {"darkgrey", 0xa9a9a9},  {"gray", 0x808080},       {"green", 0x008000},
    {"grey", 0x808080},      {"ivory", 0xfffff0},     {"lightblue", 0xadd8e6},  {"lightgray", 0xd3d3d3},
    {"lightgrey", 0xd3d3d3}, {"linen", 0xfaf0e6},     {"navy", 0x000080},       {"orange", 0xffa500},
    {"red", 0xff0000},       {"silver", 0xc0c0c0},    {"skyblue", 0x87ceeb},    {"slategray", 0x708090},
    {"slategrey", 0x708090}, {"steelblue", 0x4682b4}, {"whitesmoke", 0xf5f5f5}, {"white", 0xffffff},
    {"yellow", 0xffff00},
});

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

/// The colour of the digits after '#': 3, 6 or 8 of them.
std::optional<Color> parse_hex(std::string_view digits) {
  unsigned value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;

  if (digits.size() == 3) {
    // #abc stands for #aabbcc.
    return color_of(((value & 0xf00) * 0x1100) | ((value & 0x0f0) * 0x110) | ((value & 0x00f) * 0x11));
  }
  if (digits.size() == 6) return color_of(value);
  if (digits.size() == 8) {
    Color color = color_of(value >> 8);
    color.a = static_cast<float>(value & 0xff) / 255.0f;
    return color;
  }
  return std::nullopt;
}

}  // namespace

float linear_of(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float encoded_of(float linear) {
  return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

std::optional<Color> parse_color(std::string_view text) {
  if (text.starts_with('#')) return parse_hex(text.substr(1));
  const std::string name = lower_case(text);
  if (name == "transparent") return Color{0.0f, 0.0f, 0.0f, 0.0f};
  for (const auto& [known, rgb] : kNamedColors) {
    if (name == known) return color_of(rgb);
  }
  return std::nullopt;
}

ColorBytes color_bytes(const Color& color) {
  const auto byte = [](float value) { return static_cast<std::uint8_t>(std::lround(255.0f * value)); };
  return {byte(color.r), byte(color.g), byte(color.b), byte(color.a)};
}

}  // namespace ramify
