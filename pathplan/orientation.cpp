#include "pathplan/orientation.h"

#include <algorithm>
#include <numbers>

namespace ramify::pathplan {
namespace {

Vec3 random_direction(Rng& rng) {
  const double y = rng.uniform(-1.0, 1.0);
  const double azimuth = rng.uniform(0.0, 2.0 * std::numbers::pi);
  const double across = std::sqrt(1.0 - y * y);
  return {across * std::cos(azimuth), y, across * std::sin(azimuth)};
}

/// Upwards if `angle` is positive, about the horizontal axis across `direction`, at most to the vertical.
Vec3 turned(const Vec3& direction, double angle, Rng& rng) {
  if (angle == 0.0) return direction;
  const double from_up = std::acos(std::clamp(direction.y, -1.0, 1.0));
  const double after = std::clamp(from_up - angle, 0.0, std::numbers::pi);
  Vec3 sideways(direction.x, 0.0, direction.z);
  if (glm::length(sideways) < 1e-6) {  // vertical: any way is as good
    const double azimuth = rng.uniform(0.0, 2.0 * std::numbers::pi);
    sideways = {std::cos(azimuth), 0.0, std::sin(azimuth)};
  }
  return glm::normalize(sideways) * std::sin(after) + kUp * std::cos(after);
}

}  // namespace

Vec3 subgraph_direction(const Level& row, const Light& light, const Vec3& outwards, Rng& rng) {
  Vec3 direction = outwards;
  if (row.v_g == Orientation::fixed) direction = glm::normalize(row.v_g_direction);
  if (row.v_g == Orientation::random) direction = random_direction(rng);
  direction = turned(direction, radians(row.turn_deg), rng);
  if (light.pull == 0.0) return direction;
  return normalized_or(direction + light.pull * glm::normalize(light.direction), direction);
}

}  // namespace ramify::pathplan
