#include "growth/light_field.h"

#include <cmath>

#include "common/base/rng.h"

namespace ramify::growth {

Shadow LightField::uneven_sky(const Coord& voxel) const {
  const auto bits = [](int value) { return std::uint64_t{static_cast<std::uint32_t>(value)}; };
  Rng random = Rng::stream(seed_, Stream::sky, bits(voxel.x) | bits(voxel.y) << 32, bits(voxel.z));
  return static_cast<Shadow>(std::lround(-std::log(random.uniform(0.95, 1.0)) / kShadowUnit));
}

double LightField::light_in(const Coord& voxel) const {
  const double shadow = shade(voxel, grid_.at(voxel)) * kShadowUnit;
  return model_ == ShadowModel::additive ? -shadow : std::exp(-shadow);
}

double LightField::light(const Vec3& point) const {
  const Vec3 place = point / grid_.voxel_size();
  const Coord low = grid_.voxel_of((glm::floor(place)) * grid_.voxel_size());
  const Vec3 high_share = place - glm::floor(place);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Coord offset(corner & 1, corner >> 1 & 1, corner >> 2);
    const Vec3 share = glm::mix(1.0 - high_share, high_share, Vec3(offset));
    const double weight = share.x * share.y * share.z;
    if (weight > 0.0) sum += weight * light_in(low + offset);
  }
  return sum;
}

Vec3 LightField::slope(const Vec3& point, double probe) const {
  Vec3 gradient(0.0);
  for (int i = 0; i < 3; ++i) {
    Vec3 step(0.0);
    step[i] = probe * grid_.voxel_size();
    gradient[i] = (light(point + step) - light(point - step)) / (2.0 * probe);
  }
  return gradient;
}

}  // namespace ramify::growth
