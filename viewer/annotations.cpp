#include "viewer/annotations.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <span>

namespace ramify {
namespace {

using Triangles = std::vector<Vec2f>;

void add_triangle(Triangles& triangles, const Vec2f& a, const Vec2f& b, const Vec2f& c) {
  triangles.insert(triangles.end(), {a, b, c});
}

void add_rectangle(Triangles& triangles, const Vec2f& low, const Vec2f& high) {
  add_triangle(triangles, low, {high.x, low.y}, high);
  add_triangle(triangles, low, high, {low.x, high.y});
}

void add_ellipse(Triangles& triangles, const Vec2f& center, const Vec2f& radii) {
  constexpr int kCorners = 32;
  const auto corner = [&](int index) {
    const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(index) / kCorners;
    return center + radii * Vec2f(std::cos(angle), std::sin(angle));
  };
  for (int index = 0; index < kCorners; ++index) {
    add_triangle(triangles, center, corner(index), corner(index + 1));
  }
}

struct Joint {
  Vec2f at;
  float radius;
};

/// A chain of limbs: round joints with straight sides between them.
void add_limbs(Triangles& triangles, std::span<const Joint> joints) {
  for (const Joint& joint : joints) add_ellipse(triangles, joint.at, Vec2f(joint.radius));
  for (std::size_t index = 1; index < joints.size(); ++index) {
    const Joint& a = joints[index - 1];
    const Joint& b = joints[index];
    const Vec2f along = glm::normalize(b.at - a.at);
    const Vec2f side(-along.y, along.x);
    add_triangle(triangles, a.at + side * a.radius, a.at - side * a.radius, b.at - side * b.radius);
    add_triangle(triangles, a.at + side * a.radius, b.at - side * b.radius, b.at + side * b.radius);
  }
}

/// A person standing at ease, kFigureHeight tall, feet at the origin.
Triangles figure() {
  Triangles triangles;
  add_ellipse(triangles, {0.0f, 1.632f}, {0.083f, 0.118f});
  // Half of the outline from the neck to the hip; mirrored row by row.
  constexpr std::array<Vec2f, 12> kTrunk = {{{0.056f, 1.560f},
                                             {0.058f, 1.500f},
                                             {0.085f, 1.472f},
                                             {0.150f, 1.450f},
                                             {0.192f, 1.420f},
                                             {0.190f, 1.340f},
                                             {0.166f, 1.220f},
                                             {0.148f, 1.100f},
                                             {0.156f, 1.000f},
                                             {0.172f, 0.900f},
                                             {0.168f, 0.840f},
                                             {0.140f, 0.790f}}};
  for (std::size_t row = 1; row < kTrunk.size(); ++row) {
    const Vec2f& a = kTrunk[row - 1];
    const Vec2f& b = kTrunk[row];
    add_triangle(triangles, {-a.x, a.y}, {-b.x, b.y}, b);
    add_triangle(triangles, {-a.x, a.y}, b, a);
  }
  for (float side : {-1.0f, 1.0f}) {
    add_limbs(triangles, std::array<Joint, 5>{{{{side * 0.172f, 1.396f}, 0.054f},
                                               {{side * 0.205f, 1.260f}, 0.048f},
                                               {{side * 0.228f, 1.110f}, 0.042f},
                                               {{side * 0.248f, 0.880f}, 0.029f},
                                               {{side * 0.250f, 0.800f}, 0.036f}}});
    add_limbs(triangles, std::array<Joint, 5>{{{{side * 0.084f, 0.840f}, 0.086f},
                                               {{side * 0.094f, 0.500f}, 0.060f},
                                               {{side * 0.100f, 0.350f}, 0.058f},
                                               {{side * 0.102f, 0.200f}, 0.044f},
                                               {{side * 0.102f, 0.080f}, 0.037f}}});
    add_limbs(triangles,
              std::array<Joint, 2>{{{{side * 0.104f, 0.036f}, 0.036f}, {{side * 0.152f, 0.026f}, 0.026f}}});
  }
  return triangles;
}

/// A character drawn with strokes, in a box of height 1: polylines one after another, each ended by kPenUp.
/// Only those that length_label() writes are there.
struct Glyph {
  char character;
  float advance;
  std::vector<Vec2f> strokes;
};

const Vec2f kPenUp(-1.0f);

// clang-format off
const std::vector<Glyph>& glyphs() {
  static const std::vector<Glyph> kGlyphs = {
      {'0', 0.78f, {{0.30f, 0.00f}, {0.12f, 0.10f}, {0.03f, 0.32f}, {0.03f, 0.68f}, {0.12f, 0.90f},
                    {0.30f, 1.00f}, {0.48f, 0.90f}, {0.57f, 0.68f}, {0.57f, 0.32f}, {0.48f, 0.10f},
                    {0.30f, 0.00f}, kPenUp}},
      {'1', 0.60f, {{0.08f, 0.80f}, {0.32f, 1.00f}, {0.32f, 0.00f}, kPenUp}},
      {'2', 0.76f, {{0.05f, 0.78f}, {0.12f, 0.92f}, {0.29f, 1.00f}, {0.46f, 0.93f}, {0.53f, 0.76f},
                    {0.47f, 0.58f}, {0.04f, 0.00f}, {0.56f, 0.00f}, kPenUp}},
      {'5', 0.76f, {{0.50f, 1.00f}, {0.11f, 1.00f}, {0.07f, 0.56f}, {0.28f, 0.62f}, {0.47f, 0.54f},
                    {0.55f, 0.34f}, {0.48f, 0.11f}, {0.28f, 0.00f}, {0.11f, 0.05f}, {0.03f, 0.18f}, kPenUp}},
      {'c', 0.66f, {{0.48f, 0.55f}, {0.30f, 0.65f}, {0.11f, 0.55f}, {0.03f, 0.33f}, {0.11f, 0.10f},
                    {0.30f, 0.00f}, {0.48f, 0.10f}, kPenUp}},
      {'k', 0.64f, {{0.06f, 1.00f}, {0.06f, 0.00f}, kPenUp, {0.44f, 0.64f}, {0.06f, 0.28f}, kPenUp,
                    {0.19f, 0.40f}, {0.48f, 0.00f}, kPenUp}},
      {'m', 1.02f, {{0.06f, 0.64f}, {0.06f, 0.00f}, kPenUp, {0.06f, 0.46f}, {0.20f, 0.63f}, {0.35f, 0.62f},
                    {0.43f, 0.48f}, {0.43f, 0.00f}, kPenUp, {0.43f, 0.46f}, {0.57f, 0.63f}, {0.72f, 0.62f},
                    {0.80f, 0.48f}, {0.80f, 0.00f}, kPenUp}},
      {' ', 0.42f, {}},
  };
  return kGlyphs;
}
// clang-format on

/// The text in letters `height` tall, starting at `at`, its lower left corner.
Triangles lettering(const std::string& text, Vec2f at, float height) {
  const float pen = 0.055f * height;
  Triangles triangles;
  for (char character : text) {
    const auto glyph = std::find_if(glyphs().begin(), glyphs().end(),
                                    [=](const Glyph& known) { return known.character == character; });
    assert(glyph != glyphs().end());
    std::vector<Joint> stroke;
    for (const Vec2f& point : glyph->strokes) {
      if (point != kPenUp) {
        stroke.push_back({at + height * point, pen});
        continue;
      }
      add_limbs(triangles, stroke);
      stroke.clear();
    }
    at.x += glyph->advance * height;
  }
  return triangles;
}

}  // namespace

double bar_length(double length) {
  assert(length > 0.0);
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  // A length of 5 must not lose against 4.999...
  for (double step : {10.0, 5.0, 2.0}) {
    if (step * power <= length * (1.0 + 1e-9)) return step * power;
  }
  return power;
}

std::string length_label(double length) {
  const auto rounded = [](double value) { return std::round(value * 1e6) / 1e6; };
  if (length >= 1000.0) return fmt::format("{} km", rounded(length / 1000.0));
  if (length >= 1.0) return fmt::format("{} m", rounded(length));
  if (length >= 0.01) return fmt::format("{} cm", rounded(length * 100.0));
  return fmt::format("{} mm", rounded(length * 1000.0));
}

Annotations make_annotations(const glm::dvec2& low, const glm::dvec2& high) {
  const double size = std::max({high.x - low.x, high.y - low.y, kFigureHeight});
  Annotations annotations;

  // The figure's arms reach 0.29 m to each side.
  const float stand = static_cast<float>(low.x - 0.05 * size - 0.3);
  annotations.figure = figure();
  for (Vec2f& corner : annotations.figure) corner.x += stand;

  const float length = static_cast<float>(bar_length(0.3 * size));
  const float thickness = static_cast<float>(0.006 * size);
  const float tick = 3.0f * thickness;
  const float left = stand - 0.3f;
  const float top = static_cast<float>(std::min(low.y, 0.0) - 0.04 * size);
  add_rectangle(annotations.bar, {left, top - thickness}, {left + length, top});
  for (float x : {left, left + length - thickness}) {
    add_rectangle(annotations.bar, {x, top - tick}, {x + thickness, top});
  }
  const float letter = static_cast<float>(0.026 * size);
  const Triangles label =
      lettering(length_label(length), {left + length + 2.0f * thickness, top - letter}, letter);
  annotations.bar.insert(annotations.bar.end(), label.begin(), label.end());
  return annotations;
}

Annotations annotations_beside(const Box& box, const Vec3& base, double azimuth_deg) {
  const CameraAxes axes = camera_axes(azimuth_deg, 0.0);
  Box extent;
  for (const Vec3& corner : corners(box)) extent.include(axes.coordinates(corner - base));
  return make_annotations(glm::dvec2(extent.low), glm::dvec2(extent.high));
}

}  // namespace ramify
