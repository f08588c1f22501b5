#include "common/mesh/wood.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ramify {
namespace {

// The bark of most trees, linear RGB.
constexpr Vec3f kBarkColor(0.17f, 0.12f, 0.085f);

// Of the greatest coordinate: some twenty steps of a float there.
constexpr double kThinnestShare = 2e-6;

constexpr std::size_t kSpareShare = 16;

Material bark_material() {
  Material bark;
  bark.name = "bark";
  bark.color = kBarkColor;
  return bark;
}

}  // namespace

Mesh wood_of_size(std::size_t vertices, std::size_t triangles, Mesh memory) {
  Mesh mesh = emptied(std::move(memory));
  // Room for the bark over forks: arrays of a large tree need not be moved, and memory that is not touched
  // costs nothing.
  const std::size_t most_vertices = vertices + vertices / kSpareShare;
  mesh.positions.reserve(most_vertices);
  mesh.normals.reserve(most_vertices);
  mesh.uvs.reserve(most_vertices);
  mesh.internodes.reserve(most_vertices);
  mesh.triangles.reserve(triangles + triangles / kSpareShare);
  mesh.positions.resize(vertices);
  mesh.normals.resize(vertices);
  mesh.uvs.resize(vertices);
  mesh.internodes.resize(vertices);
  mesh.triangles.resize(triangles);
  finish_wood(mesh);
  return mesh;
}

void finish_wood(Mesh& mesh) {
  if (mesh.triangles.empty()) return;
  mesh.materials.push_back(bark_material());
  mesh.ranges.push_back({0, 0, mesh.triangles.size()});
}

std::uint32_t side_count(double diameter, double greatest, const MesherOptions& options) {
  const double share = greatest > 0 ? std::sqrt(diameter / greatest) : 1.0;
  const int sides = static_cast<int>(options.sides_max * share + 0.5);
  return static_cast<std::uint32_t>(std::clamp(sides, options.sides_min, options.sides_max));
}

std::uint32_t bands_of_taper(double base_radius, double radius) {
  constexpr double least = 1.5;  // widths to one another
  constexpr double step = 0.5;   // in widths of the thinner end
  constexpr double most = 16.0;
  const auto [thin, thick] = std::minmax(base_radius, radius);
  if (thick <= least * thin) return 1;
  return static_cast<std::uint32_t>(std::min(std::ceil((thick - thin) / (step * thin)), most));
}

const Vec2f* unit_circle(std::uint32_t sides) {
  constexpr std::uint32_t most = 128;
  struct Circles {
    std::array<Vec2f, most*(most + 1) / 2> points;
    Circles() {
      for (std::uint32_t n = 1; n <= most; ++n) {
        for (std::uint32_t i = 0; i < n; ++i) {
          const double angle = 2.0 * std::numbers::pi * i / n;
          points[n * (n - 1) / 2 + i] = {static_cast<float>(std::cos(angle)),
                                         static_cast<float>(std::sin(angle))};
        }
      }
    }
  };
  static const Circles circles;
  return &circles.points[sides * (sides - 1) / 2];
}

double thinnest_radius(double farthest) {
  return std::max(farthest, 1e-3) * kThinnestShare;
}

double thinnest_radius(const Skeleton& skeleton) {
  double farthest = 0.0;
  for (const Vec3& p : skeleton.position)
    farthest = std::max({farthest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return thinnest_radius(farthest);
}

}  // namespace ramify
