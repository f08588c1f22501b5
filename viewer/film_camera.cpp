#include "viewer/film_camera.h"

#include <algorithm>
#include <array>

#include "common/mesh/mesh.h"

namespace ramify {
namespace {

// A view between two points of a ring misses its edge by (1 - cos(0.5 degrees)), less than 1/20 of a pixel in
// a thousand.
constexpr int kPointsOfRing = 360;

// Layers of the room's height, with a ring at each edge.
constexpr int kLayers = 64;

}  // namespace

std::vector<Vec3f> film_room(const Scene& finished, std::span<const Vec3> whole, RenderStyle style) {
  std::vector<Vec3f> room(whole.begin(), whole.end());
  if (style != RenderStyle::skeleton && finished.mesh != nullptr) {
    room.insert(room.end(), finished.mesh->positions.begin(), finished.mesh->positions.end());
  }
  return room;
}

std::vector<Vec3f> swept_room(std::span<const Vec3f> room) {
  Box box;
  for (const Vec3f& point : room) box.include(Vec3(point));
  if (box.is_empty()) return {};
  const Vec3 middle = box.center();
  const double layer_height = box.size().y / kLayers;
  std::array<double, kLayers> radius{};
  for (const Vec3f& point : room) {
    const double layer = layer_height > 0.0 ? (point.y - box.low.y) / layer_height : 0.0;
    double& widest = radius[static_cast<std::size_t>(std::clamp(static_cast<int>(layer), 0, kLayers - 1))];
    widest = std::max(widest, glm::length(glm::dvec2(point.x - middle.x, point.z - middle.z)));
  }
  std::vector<Vec3f> swept;
  for (int edge = 0; edge <= kLayers; ++edge) {
    // A ring between two layers is as wide as the wider of them.
    const double below = edge > 0 ? radius[static_cast<std::size_t>(edge - 1)] : 0.0;
    const double above = edge < kLayers ? radius[static_cast<std::size_t>(edge)] : 0.0;
    const double wide = std::max(below, above);
    for (int index = 0; index < kPointsOfRing; ++index) {
      const double angle = radians(360.0 * index / kPointsOfRing);
      swept.emplace_back(middle.x + wide * std::cos(angle), box.low.y + edge * layer_height,
                         middle.z + wide * std::sin(angle));
    }
  }
  return swept;
}

}  // namespace ramify
