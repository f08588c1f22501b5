#include "common/mesh/bark_texture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "common/base/color.h"
#include "common/base/parallel.h"

namespace ramify {
namespace {

/// Bits that depend on a lattice point and a layer.
std::uint32_t hashed(int x, int y, std::uint32_t layer) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9e3779b1u ^
                    static_cast<std::uint32_t>(y) * 0x85ebca77u ^ layer * 0xc2b2ae3du;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return h ^ (h >> 15);
}

float unit(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1.0p-24f;
}

int wrapped(int i, int period) {
  const int rest = i % period;
  return rest < 0 ? rest + period : rest;
}

float smoothstep(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

/// Gradient noise, about -1 to 1, with `cells` lattice cells a unit each way: u and v from 0 to 1 repeat.
float noise(float u, float v, Coord cells, std::uint32_t layer) {
  const float x = u * static_cast<float>(cells.x);
  const float y = v * static_cast<float>(cells.y);
  const float x0 = std::floor(x);
  const float y0 = std::floor(y);
  const auto slope = [&](int dx, int dy) {
    const std::uint32_t bits = hashed(wrapped(static_cast<int>(x0) + dx, cells.x),
                                      wrapped(static_cast<int>(y0) + dy, cells.y), layer);
    const float gx = static_cast<float>(bits & 0xffffu) / 32767.5f - 1.0f;
    const float gy = static_cast<float>(bits >> 16) / 32767.5f - 1.0f;
    return gx * (x - x0 - static_cast<float>(dx)) + gy * (y - y0 - static_cast<float>(dy));
  };
  const auto eased = [](float t) { return t * t * t * (t * (6.0f * t - 15.0f) + 10.0f); };
  const float s = eased(x - x0);
  return 1.4f * std::lerp(std::lerp(slope(0, 0), slope(1, 0), s), std::lerp(slope(0, 1), slope(1, 1), s),
                          eased(y - y0));
}

/// Octaves of noise, each twice as fine and half as strong.
float turbulence(float u, float v, Coord cells, int octaves, std::uint32_t layer) {
  float sum = 0.0f;
  float weight = 0.5f;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += weight * noise(u, v, cells, layer + static_cast<std::uint32_t>(octave));
    cells *= 2;
    weight *= 0.5f;
  }
  return sum;
}

struct CellPlace {
  float edge = 0.0f;   // how much nearer the nearest feature point is than the second, in cells
  float value = 0.0f;  // of the cell, 0 to 1
};

/// The cellular basis function on `cells` periodic cells.
CellPlace cell_at(float u, float v, Coord cells, std::uint32_t layer) {
  const float x = u * static_cast<float>(cells.x);
  const float y = v * static_cast<float>(cells.y);
  const int x0 = static_cast<int>(std::floor(x));
  const int y0 = static_cast<int>(std::floor(y));
  float nearest = 1e9f;
  float second = 1e9f;
  CellPlace place;
  for (int j = y0 - 1; j <= y0 + 1; ++j) {
    for (int i = x0 - 1; i <= x0 + 1; ++i) {
      const std::uint32_t bits = hashed(wrapped(i, cells.x), wrapped(j, cells.y), layer);
      const float dx = static_cast<float>(i) + unit(bits) - x;
      const float dy = static_cast<float>(j) + unit(bits * 0x9e3779b1u) - y;
      const float distance = std::sqrt(dx * dx + dy * dy);
      if (distance < nearest) {
        second = nearest;
        nearest = distance;
        place.value = unit(bits * 0x85ebca77u);
      } else {
        second = std::min(second, distance);
      }
    }
  }
  place.edge = second - nearest;
  return place;
}

/// A point of the surface: how high it stands, in parts of the texture's width, and how light it is.
struct Surface {
  float height = 0.0f;
  float shade = 0.0f;  // linear, 0 to 1
};

/// Ridges that run up the stem, part and join; furrows between them are dark, their backs cracked and
/// fibrous.
Surface ridged_surface(float u, float v) {
  const float sway = 0.10f * turbulence(u, v, {3, 3, 1}, 2, 11);
  const float across = u + sway;
  const float along = v + 0.05f * noise(u, v, {6, 4, 1}, 21);
  const CellPlace ridge = cell_at(across, along, {9, 3, 1}, 31);
  const CellPlace crack = cell_at(across, along + 0.3f * ridge.value, {11, 12, 1}, 41);
  const float fibers = turbulence(across, v, {40, 6, 1}, 3, 51);
  const float back = smoothstep(0.02f, 0.42f, ridge.edge);
  const float cracked = smoothstep(0.0f, 0.16f, crack.edge);
  Surface at;
  at.height = 0.034f * back * (0.72f + 0.28f * cracked) + 0.006f * fibers + 0.006f * ridge.value * back;
  at.shade =
      (0.16f + 0.62f * back) * (0.75f + 0.25f * cracked) + 0.16f * fibers + 0.10f * (ridge.value - 0.5f);
  return at;
}

/// Hardly any relief; lenticels, short corky lines across the stem, and faint rings.
Surface smooth_surface(float u, float v) {
  const float clouds = turbulence(u, v, {3, 3, 1}, 4, 12);
  const float rings = noise(u, v, {4, 48, 1}, 22);
  const float grain = noise(u, v, {128, 128, 1}, 32);
  // A lattice of cells, most of them without a lenticel: a short flat ellipse in its middle.
  const Coord cells(7, 34, 1);
  const float x = u * static_cast<float>(cells.x);
  const float y = v * static_cast<float>(cells.y) + 0.15f * noise(u, v, {9, 9, 1}, 42);
  float lenticel = 0.0f;
  for (int di = -1; di <= 1; ++di) {
    const int i = static_cast<int>(std::floor(x)) + di;
    const int j = static_cast<int>(std::floor(y));
    const std::uint32_t bits = hashed(wrapped(i, cells.x), wrapped(j, cells.y), 52);
    if (unit(bits) > 0.30f) continue;
    const float half_width = 0.18f + 0.45f * unit(bits * 0x9e3779b1u);
    const float dx =
        (x - static_cast<float>(i) - 0.5f - 0.5f * (unit(bits * 0x85ebca77u) - 0.5f)) / half_width;
    const float dy = (y - static_cast<float>(j) - 0.5f) / 0.20f;
    lenticel = std::max(lenticel, 1.0f - smoothstep(0.55f, 1.0f, std::sqrt(dx * dx + dy * dy)));
  }
  Surface at;
  at.height = 0.003f * clouds + 0.0012f * rings + 0.0035f * lenticel;
  at.shade = 0.72f + 0.20f * clouds + 0.07f * rings + 0.04f * grain - 0.38f * lenticel;
  return at;
}

/// Plates with a deep dark joint around each, in thin layers that flake off.
Surface plated_surface(float u, float v) {
  const float sway = 0.05f * turbulence(u, v, {4, 4, 1}, 3, 13);
  const float across = u + sway;
  const float along = v + 0.05f * turbulence(u, v, {5, 4, 1}, 3, 23);
  const CellPlace plate = cell_at(across, along, {5, 4, 1}, 33);
  const float flakes = turbulence(across, along, {9, 7, 1}, 3, 43);
  const float layers = 4.0f * (flakes + plate.value);
  const float layer = std::floor(layers) + smoothstep(0.80f, 1.0f, layers - std::floor(layers));
  const float grain = turbulence(u, v, {48, 32, 1}, 2, 53);
  const float top = smoothstep(0.03f, 0.20f, plate.edge);
  Surface at;
  at.height = 0.026f * top + 0.0035f * layer * top + 0.003f * grain;
  at.shade = 0.15f + top * (0.44f + 0.055f * layer) + 0.12f * grain;
  return at;
}

Surface surface_at(BarkKind kind, float u, float v) {
  switch (kind) {
    case BarkKind::smooth:
      return smooth_surface(u, v);
    case BarkKind::plated:
      return plated_surface(u, v);
    default:
      return ridged_surface(u, v);
  }
}

std::uint8_t byte_of(float part) {
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(part, 0.0f, 1.0f)));
}

/// From heights in parts of the texture's width; row 0 is the top.
Image normals_of(const std::vector<float>& heights, int size) {
  Image image{size, size, std::vector<std::uint8_t>(4 * heights.size())};
  const auto height = [&](int x, int y) {
    return heights[static_cast<std::size_t>(wrapped(y, size)) * size +
                   static_cast<std::size_t>(wrapped(x, size))];
  };
  const float scale = 0.5f * static_cast<float>(size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec3f normal = glm::normalize(Vec3f(scale * (height(x - 1, y) - height(x + 1, y)),
                                                scale * (height(x, y + 1) - height(x, y - 1)), 1.0f));
      std::uint8_t* pixel = image.rgba.data() + 4 * (static_cast<std::size_t>(y) * size + x);
      for (int axis = 0; axis < 3; ++axis) pixel[axis] = byte_of(0.5f + 0.5f * normal[axis]);
      pixel[3] = 255;
    }
  }
  return image;
}

}  // namespace

BarkTexture make_bark_texture(BarkKind kind, int resolution) {
  assert(kind != BarkKind::plain);
  const auto size = static_cast<std::size_t>(resolution);
  std::vector<float> heights(size * size);
  std::vector<float> shades(size * size);
  BarkTexture texture;
  texture.shade = {resolution, resolution, std::vector<std::uint8_t>(4 * size * size, 255)};
  parallel_for(size, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      for (std::size_t x = 0; x < size; ++x) {
        const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(resolution);
        const float v = 1.0f - (static_cast<float>(y) + 0.5f) / static_cast<float>(resolution);
        const Surface at = surface_at(kind, u, v);
        heights[y * size + x] = at.height;
        shades[y * size + x] = std::clamp(at.shade, 0.02f, 1.0f);
        const std::uint8_t byte = byte_of(encoded_of(shades[y * size + x]));
        std::fill_n(texture.shade.rgba.begin() + static_cast<std::ptrdiff_t>(4 * (y * size + x)), 3, byte);
      }
    }
  });
  double sum = 0.0;
  for (const float shade : shades) sum += shade;
  texture.mean_shade = sum / static_cast<double>(shades.size());
  texture.normal_map = normals_of(heights, resolution);
  return texture;
}

}  // namespace ramify
