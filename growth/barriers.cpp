#include "growth/barriers.h"

#include <algorithm>

namespace ramify::growth {

Barriers::Barriers(const Parameters& world) : has_ground_(world.ground), ground_schedule_(world.ground_y) {
  for (const Obstacle& obstacle : world.obstacles) {
    if (obstacle.blocks) solids_.emplace_back(obstacle.volume);
  }
}

void Barriers::set_step(int step) {
  ground_y_ = ground_schedule_.at(step);
}

bool Barriers::block(const Vec3& from, const Vec3& to) const {
  if (has_ground_ && to.y < ground_y_) return true;
  return std::any_of(solids_.begin(), solids_.end(),
                     [&](const Solid& solid) { return solid.meets(from, to); });
}

std::vector<Coord> voxels_inside(const Volume& volume, double voxel_size) {
  const Solid solid(volume);
  const Box box = solid.bounds();
  std::vector<Coord> inside;
  if (box.is_empty()) return inside;
  const Coord low(glm::ceil(box.low / voxel_size));
  const Coord high(glm::floor(box.high / voxel_size));
  for (int x = low.x; x <= high.x; ++x) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int z = low.z; z <= high.z; ++z) {
        if (solid.contains(Vec3(x, y, z) * voxel_size)) inside.emplace_back(x, y, z);
      }
    }
  }
  return inside;
}

}  // namespace ramify::growth
