#include "common/mesh/leaf_shapes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "common/base/color.h"
#include "common/base/parallel.h"

namespace ramify {
namespace {

constexpr int kPictureSize = 256;  // pixels a side

// Of its length: how far a blade is folded up along its midrib, and how far its tip hangs below its base.
constexpr double kFold = 0.35;
constexpr double kSag = 0.16;

// The stalk, in parts of the leaf's length.
constexpr double kStalkWidth = 0.012;

struct Station {
  double t;
  double half_width;
};

// Where outlines change, measured along the midrib; between stations they run straight or, in smooth ones, in
// an arc.
constexpr Station kOvate[] = {{0.00, kStalkWidth}, {0.17, kStalkWidth}, {0.22, 0.12},
                              {0.32, 0.225},       {0.46, 0.26},        {0.62, 0.225},
                              {0.78, 0.14},        {0.90, 0.055},       {1.00, 0.0}};
constexpr Station kLanceolate[] = {{0.00, kStalkWidth}, {0.08, kStalkWidth}, {0.18, 0.045}, {0.35, 0.082},
                                   {0.55, 0.085},       {0.78, 0.050},       {1.00, 0.0}};
// Rounded lobes on both sides, the broadest beyond the middle, as of an oak.
constexpr Station kLobed[] = {{0.00, kStalkWidth}, {0.07, kStalkWidth}, {0.13, 0.070}, {0.20, 0.130},
                              {0.25, 0.125},       {0.29, 0.075},       {0.36, 0.165}, {0.42, 0.205},
                              {0.47, 0.190},       {0.51, 0.100},       {0.58, 0.215}, {0.65, 0.270},
                              {0.70, 0.250},       {0.74, 0.130},       {0.81, 0.195}, {0.87, 0.210},
                              {0.91, 0.165},       {0.94, 0.125},       {0.98, 0.085}, {1.00, 0.0}};
constexpr Station kNeedle[] = {{0.0, 0.011}, {1.0, 0.0}};

std::span<const Station> outline_of(LeafShape shape) {
  switch (shape) {
    case LeafShape::lanceolate:
      return kLanceolate;
    case LeafShape::lobed:
      return kLobed;
    case LeafShape::needles:
      return kNeedle;
    default:
      return kOvate;
  }
}

double greatest_half_width(LeafShape shape) {
  double greatest = 0.0;
  for (const Station& station : outline_of(shape)) greatest = std::max(greatest, station.half_width);
  return greatest;
}

/// Of the outline, both halves: trapezoids between stations.
double blade_area(LeafShape shape) {
  const std::span<const Station> outline = outline_of(shape);
  double area = 0.0;
  for (std::size_t i = 1; i < outline.size(); ++i) {
    area += (outline[i].t - outline[i - 1].t) * (outline[i].half_width + outline[i - 1].half_width);
  }
  return area;
}

/// How far the picture reaches to each side of the midrib.
double picture_half_width(LeafShape shape) {
  return 1.04 * greatest_half_width(shape);
}

std::uint32_t add_vertex(Mesh& mesh, const Vec3& at, const Vec3& normal, const Vec2f& uv) {
  mesh.positions.emplace_back(at);
  mesh.normals.emplace_back(normalized_or(normal, Vec3(0, 0, 1)));
  mesh.uvs.push_back(uv);
  return static_cast<std::uint32_t>(mesh.positions.size()) - 1;
}

/// A point of the blade, which is folded along its midrib and bent down towards its tip: a parabola.
struct BladePoint {
  Vec3 at;
  Vec3 normal;
};

BladePoint blade_point(double x, double t) {
  const double slope = -2.0 * kSag * t;
  const double fold = x == 0.0 ? 0.0 : std::copysign(kFold, x);
  return {{x, t, kFold * std::abs(x) - kSag * t * t}, Vec3(-0.6 * fold, -slope, 1.0)};
}

/// Rows of three vertices, left, middle and right, with strips between them; a row without width is the one
/// vertex of the tip.
void add_blade(LeafShape shape, std::span<const Station> rows, Mesh& mesh) {
  const double side = picture_half_width(shape);
  const auto add_point = [&](double x, double t) {
    const BladePoint point = blade_point(x, t);
    return add_vertex(mesh, point.at, point.normal, {0.5 + 0.5 * x / side, t});
  };
  std::uint32_t below = 0;  // the left vertex of the row before
  for (const auto& [t, width] : rows) {
    const bool is_tip = width == 0.0;
    const std::uint32_t left = add_point(-width, t);
    if (!is_tip) {
      add_point(0.0, t);
      add_point(width, t);
    }
    for (std::uint32_t half = 0; half < 2 && left > 0; ++half) {
      const std::uint32_t low = below + half;
      const std::uint32_t high = is_tip ? left : left + half;
      if (!is_tip) mesh.triangles.push_back({low, high + 1, high});
      mesh.triangles.push_back({low, low + 1, is_tip ? high : high + 1});
    }
    below = left;
  }
}

// --- Needles: a tuft of them, around the direction in which it grows -------------------------------------

constexpr int kNeedles = 14;
constexpr double kNeedleBase = 0.02;  // where they begin, in parts of the tuft's length
constexpr double kGoldenAngle = 2.39996;

/// Where the i-th needle points to: the first ahead, the later ones more and more to the sides.
Vec3 needle_direction(int i) {
  const double spread = radians(14.0 + 52.0 * std::sqrt((i + 0.5) / kNeedles));
  const double azimuth = kGoldenAngle * i;
  return {std::sin(spread) * std::cos(azimuth), std::cos(spread), std::sin(spread) * std::sin(azimuth)};
}

double needle_length(int i) {
  return 0.82 + 0.18 * std::cos(5.0 * i);
}

/// Flat strips that end in a point, each turned so that its face looks away from the tuft's axis.
void add_needles(Mesh& mesh) {
  const double width = greatest_half_width(LeafShape::needles);
  for (int i = 0; i < kNeedles; ++i) {
    const Vec3 along = needle_direction(i);
    const Vec3 side = glm::normalize(glm::cross(along, Vec3(0, 1, 0)));
    const Vec3 normal = glm::cross(side, along);
    const Vec3 base = along * kNeedleBase;
    const std::uint32_t first = add_vertex(mesh, base - side * width, normal, {0.48f, 0.0f});
    add_vertex(mesh, base + side * width, normal, {0.52f, 0.0f});
    add_vertex(mesh, along * needle_length(i), normal, {0.5f, 1.0f});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
}

/// The tuft as a picture on two upright quads that cross.
void add_crossed_cards(Mesh& mesh) {
  const double side = 0.62;
  for (const Vec3& across : {Vec3(1, 0, 0), Vec3(0, 0, 1)}) {
    const Vec3 normal = glm::cross(across, Vec3(0, 1, 0));
    const std::uint32_t first = add_vertex(mesh, -across * side, normal, {0.0f, 0.0f});
    add_vertex(mesh, across * side, normal, {1.0f, 0.0f});
    add_vertex(mesh, across * side + Vec3(0, 1, 0), normal, {1.0f, 1.0f});
    add_vertex(mesh, -across * side + Vec3(0, 1, 0), normal, {0.0f, 1.0f});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
}

// --- Pictures ---------------------------------------------------------------------------------------------

/// A pixel: light from 0 to 1, and how far outside the leaf's edge it is, in parts of the leaf's length;
/// negative inside.
struct Ink {
  double shade = 1.0;
  double outside = 0.0;
};

double line(double distance, double width) {
  return std::exp(-0.5 * distance * distance / (width * width));
}

/// The blade at x from the midrib, t along it: midrib, side veins that rise towards the tip, and a rim.
Ink blade_ink(LeafShape shape, double x, double t) {
  const double width = half_width(shape, t);
  const double away = std::abs(x);
  const double spacing = shape == LeafShape::lanceolate ? 0.06 : 0.11;
  const double rank = (t - 0.75 * away) / spacing;
  const double to_vein = (rank - std::round(rank)) * spacing;
  const double veins = 0.16 * line(to_vein, 0.006) * std::min(1.0, away / 0.01) + 0.24 * line(away, 0.007);
  const double between = 0.06 * std::cos(2.0 * std::numbers::pi * rank);
  return {0.84 + veins - between - 0.10 * away / greatest_half_width(shape), away - width};
}

/// A straight needle on the picture of a tuft.
struct DrawnNeedle {
  glm::dvec2 base;
  glm::dvec2 tip;
  double shade;
};

/// More than the geometry's, since those behind must be drawn too.
std::vector<DrawnNeedle> drawn_needles() {
  constexpr int kDrawn = 34;
  std::vector<DrawnNeedle> needles;
  for (int i = 0; i < kDrawn; ++i) {
    const double spread = radians(64.0) * (2.0 * (i * 0.618034 - std::floor(i * 0.618034)) - 1.0);
    const double length = 0.94 - 0.32 * std::abs(spread) + 0.05 * std::cos(7.0 * i);
    const double base = 0.16 * (i % 5) / 5.0;
    needles.push_back(
        {{0.0, base},
         glm::dvec2(0.0, base) + glm::dvec2(std::sin(spread), std::cos(spread)) * (length - base),
         0.55 + 0.4 * i / kDrawn});
  }
  return needles;
}

Ink tuft_ink(std::span<const DrawnNeedle> needles, double x, double t) {
  Ink ink{0.7, 1.0};
  for (const DrawnNeedle& needle : needles) {
    const glm::dvec2 along = needle.tip - needle.base;
    const glm::dvec2 to(x - needle.base.x, t - needle.base.y);
    const double part = std::clamp(glm::dot(to, along) / glm::dot(along, along), 0.0, 1.0);
    const double outside = glm::length(to - part * along) - 0.011 * (1.15 - 0.8 * part * part);
    if (outside < 0.0 || outside < ink.outside) ink = {needle.shade, std::min(outside, ink.outside)};
  }
  return ink;
}

/// Shades everywhere, so that coarser copies do not bring a foreign colour to the edge; `is_cutout`:
/// transparent outside the leaf.
Image picture(LeafShape shape, bool is_cutout) {
  const std::vector<DrawnNeedle> needles = drawn_needles();
  const bool is_tuft = shape == LeafShape::needles;
  const double side = is_tuft ? 0.62 : picture_half_width(shape);
  Image image{kPictureSize, kPictureSize, std::vector<std::uint8_t>(4 * kPictureSize * kPictureSize, 255)};
  parallel_for(kPictureSize, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      for (std::size_t x = 0; x < kPictureSize; ++x) {
        const double across = side * (2.0 * (static_cast<double>(x) + 0.5) / kPictureSize - 1.0);
        const double t = 1.0 - (static_cast<double>(y) + 0.5) / kPictureSize;
        const Ink ink = is_tuft ? tuft_ink(needles, across, t) : blade_ink(shape, across, t);
        std::uint8_t* pixel = image.rgba.data() + 4 * (y * kPictureSize + x);
        const float shade = encoded_of(static_cast<float>(std::clamp(ink.shade, 0.0, 1.0)));
        std::fill_n(pixel, 3, static_cast<std::uint8_t>(std::lround(255.0f * shade)));
        if (!is_cutout) continue;
        // One half at the edge, from 0 to 1 within a pixel's width.
        const double alpha = 0.5 - ink.outside * kPictureSize / 2.0;
        pixel[3] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(alpha, 0.0, 1.0)));
      }
    }
  });
  return image;
}

/// A card takes only the rows that bend it.
std::vector<Station> card_rows(LeafShape shape) {
  const double side = picture_half_width(shape);
  return {{0.0, side}, {0.5, side}, {1.0, side}};
}

}  // namespace

double half_width(LeafShape shape, double t) {
  const std::span<const Station> outline = outline_of(shape);
  if (t < 0.0 || t > 1.0) return 0.0;
  std::size_t next = 1;
  while (next + 1 < outline.size() && outline[next].t < t) ++next;
  const Station& low = outline[next - 1];
  const Station& high = outline[next];
  return std::lerp(low.half_width, high.half_width, (t - low.t) / (high.t - low.t));
}

LeafModel make_leaf(LeafShape shape, LeafForm form) {
  assert(shape != LeafShape::none);
  LeafModel leaf;
  Mesh& mesh = leaf.mesh;
  const bool is_card = form == LeafForm::card;
  if (shape == LeafShape::needles) {
    is_card ? add_crossed_cards(mesh) : add_needles(mesh);
    for (int i = 0; i < kNeedles; ++i) {
      leaf.area += (needle_length(i) - kNeedleBase) * greatest_half_width(shape);
    }
  } else {
    is_card ? add_blade(shape, card_rows(shape), mesh) : add_blade(shape, outline_of(shape), mesh);
    leaf.area = blade_area(shape);
  }
  Material material;
  material.name = "leaf";
  material.roughness = 0.6f;
  if (is_card || shape != LeafShape::needles) material.image = picture(shape, is_card);
  material.is_cutout = true;
  material.is_two_sided = true;
  mesh.materials.push_back(std::move(material));
  mesh.ranges.push_back({0, 0, mesh.triangles.size()});
  return leaf;
}

}  // namespace ramify
