#include "viewer/sky_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace ramify {
namespace {

// Along the box's longest side. Finer cells would show the twigs one by one, which the shadows do already.
constexpr int kCellsAlong = 48;

// Free cells around the mesh, so that the ground beside it darkens softly, in parts of its size.
constexpr double kBorder = 0.15;

// A direction that light comes from, and its share of the sky.
struct SkyPatch {
  Vec3 direction;
  double weight;
};

/// The zenith and rings of six at 55 and 25 degrees, weighted by their solid angle and its cosine's mean.
std::vector<SkyPatch> sky_patches() {
  std::vector<SkyPatch> patches{{kUp, 0.16}};
  for (int ring = 0; ring < 2; ++ring) {
    const double elevation = radians(ring == 0 ? 55.0 : 25.0);
    for (int index = 0; index < 6; ++index) {
      const double azimuth = radians(60.0 * index + 30.0 * ring);
      patches.push_back({{std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                          std::cos(elevation) * std::sin(azimuth)},
                         ring == 0 ? 0.085 : 0.055});
    }
  }
  return patches;
}

/// Adds the triangles' areas to the cells they lie in, square metres.
std::vector<double> wood_areas(const Mesh& mesh, const SkyLight& cells, double cell) {
  std::vector<double> areas(cells.visibility.size(), 0.0);
  for (const auto& [a, b, c] : std::span(mesh.triangles).first(solid_part(mesh).triangle_count)) {
    const Vec3 corners[] = {Vec3(mesh.positions[a]), Vec3(mesh.positions[b]), Vec3(mesh.positions[c])};
    const Vec3 u = corners[1] - corners[0];
    const Vec3 v = corners[2] - corners[0];
    const double area = 0.5 * glm::length(glm::cross(u, v));
    const double longest = std::max(glm::length(u), glm::length(v));
    // A long triangle of a trunk is spread over the cells it passes.
    const int pieces = std::clamp(static_cast<int>(std::ceil(longest / cell)), 1, kCellsAlong);
    for (int piece = 0; piece < pieces; ++piece) {
      const double t = (piece + 0.5) / pieces;
      const Vec3 at = (corners[0] + t * (u + v) / 2.0 - cells.box.low) / cell;
      const Coord c3 = glm::clamp(Coord(glm::floor(at)), Coord(0), cells.size - 1);
      areas[cells.index(c3.x, c3.y, c3.z)] += area / pieces;
    }
  }
  return areas;
}

/// The value at fractional cell coordinates in the layer y, between its four neighbours; `outside` beyond.
double sample_layer(const SkyLight& cells, const std::vector<double>& values, double x, int y, double z,
                    double outside) {
  const int x0 = static_cast<int>(std::floor(x));
  const int z0 = static_cast<int>(std::floor(z));
  const auto at = [&](int i, int k) {
    const bool is_inside = i >= 0 && k >= 0 && i < cells.size.x && k < cells.size.z;
    return is_inside ? values[cells.index(i, y, k)] : outside;
  };
  const double u = x - x0;
  const double v = z - z0;
  return std::lerp(std::lerp(at(x0, z0), at(x0 + 1, z0), u), std::lerp(at(x0, z0 + 1), at(x0 + 1, z0 + 1), u),
                   v);
}

/// The part of the patch's light that reaches each cell, from the top layer down.
void add_light(const SkyLight& cells, const std::vector<double>& depth_a_cell, const SkyPatch& patch,
               std::vector<double>& light) {
  std::vector<double> arriving(light.size(), 1.0);
  const Vec3 step = patch.direction / patch.direction.y;  // up by one layer
  const double path = glm::length(step);
  for (int y = cells.size.y - 2; y >= 0; --y) {
    for (int z = 0; z < cells.size.z; ++z) {
      for (int x = 0; x < cells.size.x; ++x) {
        const double above = sample_layer(cells, arriving, x + step.x, y + 1, z + step.z, 1.0);
        const double depth = sample_layer(cells, depth_a_cell, x + step.x, y + 1, z + step.z, 0.0);
        arriving[cells.index(x, y, z)] = above * std::exp(-depth * path);
      }
    }
  }
  for (std::size_t cell = 0; cell < light.size(); ++cell) light[cell] += patch.weight * arriving[cell];
}

}  // namespace

SkyLight sky_light(const Mesh& mesh, double ground) {
  SkyLight cells;
  Box box;
  for (const Vec3f& position : mesh.positions) box.include(Vec3(position));
  if (box.is_empty()) return cells;
  box.low.y = ground;
  box.high.y = std::max(box.high.y, ground);
  const Vec3 extent = box.size();
  const double border = kBorder * std::max({extent.x, extent.y, extent.z, 1e-3});
  box.low -= Vec3(border, 0.0, border);
  box.high += border;

  const double cell = std::max({box.size().x, box.size().y, box.size().z}) / kCellsAlong;
  cells.size = glm::max(Coord(glm::ceil(box.size() / cell - 1e-9)), Coord(1));
  cells.box = {box.low, box.low + Vec3(cells.size) * cell};
  cells.visibility.resize(static_cast<std::size_t>(cells.size.x) * cells.size.y * cells.size.z);

  std::vector<double> depth_a_cell = wood_areas(mesh, cells, cell);
  for (double& value : depth_a_cell) value /= 4.0 * cell * cell;

  std::vector<double> light(cells.visibility.size(), 0.0);
  double whole_sky = 0.0;
  for (const SkyPatch& patch : sky_patches()) {
    add_light(cells, depth_a_cell, patch, light);
    whole_sky += patch.weight;
  }
  for (std::size_t index = 0; index < light.size(); ++index) {
    cells.visibility[index] = static_cast<std::uint8_t>(std::lround(255.0 * light[index] / whole_sky));
  }
  return cells;
}

}  // namespace ramify
