#include "pathplan/surroundings.h"

#include <algorithm>

namespace ramify::pathplan {

Surroundings::Surroundings(const Parameters& parameters) {
  for (const Obstacle& obstacle : parameters.obstacles) {
    obstacle_union_.parts.push_back(obstacle.volume);
    obstacles_.emplace_back(obstacle.volume);
  }
  for (const CostVolume& cost : parameters.costs) costs_.push_back({Solid(cost.volume), cost.factor});
}

bool Surroundings::is_free(const Vec3& point) const {
  return std::none_of(obstacles_.begin(), obstacles_.end(),
                      [&](const Solid& obstacle) { return obstacle.contains(point); });
}

bool Surroundings::is_free(const Vec3& from, const Vec3& to) const {
  return std::none_of(obstacles_.begin(), obstacles_.end(),
                      [&](const Solid& obstacle) { return obstacle.meets(from, to); });
}

double Surroundings::volume_taken_of(const Volume& volume) const {
  return has_obstacles() ? shared_volume_of(volume, obstacle_union_) : 0.0;
}

double Surroundings::cost_factor(const Vec3& middle) const {
  double factor = 1.0;
  for (const Cost& cost : costs_) {
    if (cost.place.contains(middle)) factor *= cost.factor;
  }
  return factor;
}

}  // namespace ramify::pathplan
