#include "growth/phyllotaxis.h"

#include "common/base/rng.h"

namespace ramify::growth {
namespace {

// 360 degrees / golden ratio^2: the divergence of most spiral shoots.
const double kGoldenAngle = radians(137.5);

// Turning about world Z does nothing to a shoot that points along it.
const double kNearlyAlongZ = std::cos(radians(10.0));

Vec3 spiral_direction(const Axis& axis, std::uint32_t rank, double angle) {
  const double azimuth = kGoldenAngle * rank;
  const Vec3 outwards =
      axis.reference * std::cos(azimuth) + glm::cross(axis.direction, axis.reference) * std::sin(azimuth);
  return glm::normalize(axis.direction * std::cos(angle) + outwards * std::sin(angle));
}

/// S4: the axis's direction turned left or right in the XY plane, a fair coin.
Vec3 planar_direction(const Axis& axis, Rng random, double angle) {
  const double turn = random.coin() ? angle : -angle;
  const Vec3 z(0.0, 0.0, 1.0);
  if (std::abs(glm::dot(axis.direction, z)) < kNearlyAlongZ) return rotated(axis.direction, z, turn);
  const double azimuth = random.uniform(0.0, 2.0 * std::numbers::pi);
  return rotated(axis.direction, perpendicular_at(axis.direction, azimuth), turn);
}

}  // namespace

Vec3 axillary_direction(const Parameters& parameters, const Axis& axis, std::uint32_t axis_index,
                        std::uint32_t rank, int step) {
  const double angle = radians(parameters.branching_angle_deg.at(step));
  switch (parameters.phyllotaxis) {
    case Phyllotaxis::spiral:
      return spiral_direction(axis, rank, angle);
    case Phyllotaxis::planar_random:
      return planar_direction(axis, Rng::stream(parameters.seed, Stream::bud, axis_index, rank), angle);
  }
  return axis.direction;
}

}  // namespace ramify::growth
