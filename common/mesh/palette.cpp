#include "common/mesh/palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace ramify {
namespace {

constexpr Color kNoValue = color_of(0x9a9a9a);

constexpr std::array kViridis = {color_of(0x440154), color_of(0x472d7b), color_of(0x3b528b),
                                 color_of(0x2c728e), color_of(0x21918c), color_of(0x28ae80),
                                 color_of(0x5ec962), color_of(0xaddc30), color_of(0xfde725)};

// In such an order that neighbouring indices differ most.
constexpr std::array kMuted = {color_of(0x332288), color_of(0xcc6677), color_of(0x117733),
                               color_of(0xaa4499), color_of(0x999933), color_of(0x88ccee),
                               color_of(0x882255), color_of(0x44aa99), color_of(0xddcc77)};

constexpr std::array kBark = {color_of(0xa5826d), color_of(0x8f6f5c), color_of(0x7d6759), color_of(0x736356)};
constexpr std::array kSmoothBark = {color_of(0x7d5d4a), color_of(0x8a7668), color_of(0x9d968c),
                                    color_of(0xa8a49b)};
constexpr std::array kPlatedBark = {color_of(0xa08a62), color_of(0xa47b57), color_of(0x96694d),
                                    color_of(0x84685a)};
// The diameters that the first and last of these colours stand for, metres.
constexpr double kTwigDiameter = 0.006;
constexpr double kTrunkDiameter = 0.25;

/// The colour at t, from 0 to 1, between evenly spaced ones.
Color interpolated(std::span<const Color> colors, double t) {
  const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(colors.size() - 1);
  const std::size_t index = std::min(static_cast<std::size_t>(place), colors.size() - 2);
  const float weight = static_cast<float>(place - static_cast<double>(index));
  const Color& low = colors[index];
  const Color& high = colors[index + 1];
  return {std::lerp(low.r, high.r, weight), std::lerp(low.g, high.g, weight),
          std::lerp(low.b, high.b, weight), 1.0f};
}

Color color_of_width(std::span<const Color> colors, double diameter) {
  if (!(diameter > 0.0)) return colors.front();
  return interpolated(colors, std::log(diameter / kTwigDiameter) / std::log(kTrunkDiameter / kTwigDiameter));
}

}  // namespace

Color sequential_color(double t) {
  return std::isnan(t) ? kNoValue : interpolated(kViridis, t);
}

Color categorical_color(std::size_t index) {
  return kMuted[index % kMuted.size()];
}

Color bark_color(double diameter) {
  return color_of_width(kBark, diameter);
}

Color smooth_bark_color(double diameter) {
  return color_of_width(kSmoothBark, diameter);
}

Color plated_bark_color(double diameter) {
  return color_of_width(kPlatedBark, diameter);
}

}  // namespace ramify
