#include "growth/light_field.h"

#include <cmath>

#include "common/base/rng.h"

namespace ramify::growth {

Shadow LightField::uneven_sky(const Coord& voxel) const {
  const auto bits = [](int value) { return std::uint64_t{static_cast<std::uint32_t>(value)}; };
  Rng random = Rng::stream(seed_, Stream::sky, bits(voxel.x) | bits(voxel.y) << 32, bits(voxel.z));
  return static_cast<Shadow>(std::lround(-std::log(random.uniform(0.95, 1.0)) / kShadowUnit));
}

double LightField::light_in(const Coord& voxel, LeafReader& reader) const {
  const double shadow = shade(voxel, reader.at(voxel)) * kShadowUnit;
  return model_ == ShadowModel::additive ? -shadow : std::exp(-shadow);
}

double LightField::light(const Vec3& point, LeafReader& reader) const {
  const Vec3 place = point / grid_.voxel_size();
  const Vec3 below = glm::floor(place);
  const Coord low = grid_.voxel_at(below);
  const Vec3 high_share = place - below;
  const Vec3 low_share = 1.0 - high_share;
  double sum = 0.0;
  for (int z = 0; z < 2; ++z) {
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 2; ++x) {
        const double weight =
            (x ? high_share : low_share).x * (y ? high_share : low_share).y * (z ? high_share : low_share).z;
        if (weight > 0.0) sum += weight * light_in(low + Coord(x, y, z), reader);
      }
    }
  }
  return sum;
}

double LightField::light(const Vec3& point) const {
  LeafReader reader = grid_.reader();
  return light(point, reader);
}

Vec3 LightField::slope(const Vec3& point, double probe) const {
  LeafReader reader = grid_.reader();
  Vec3 gradient(0.0);
  for (int i = 0; i < 3; ++i) {
    Vec3 step(0.0);
    step[i] = probe * grid_.voxel_size();
    gradient[i] = (light(point + step, reader) - light(point - step, reader)) / (2.0 * probe);
  }
  return gradient;
}

}  // namespace ramify::growth
