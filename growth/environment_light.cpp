#include "growth/environment_light.h"

#include <algorithm>

#include "common/base/parallel.h"

namespace ramify::growth {
namespace {

// Centres on the very edge of the cone belong to it, whichever way rounding goes.
constexpr double kConeSlack = 1e-9;

}  // namespace

void sense_light(const Plant& plant, const Parameters& parameters, const ShadowGrid& shadow, int step,
                 std::vector<double>& light) {
  const double full = parameters.C.at(step);
  light.resize(plant.buds.size());
  parallel_for(plant.buds.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t node = plant.buds[i].node;
      const bool casts_itself = parameters.casters == Casters::buds || node != 0;
      const Shadow others =
          shadow.at(shadow.voxel_of(plant.position[node])) - (casts_itself ? shadow.own_shadow() : 0);
      light[i] = std::max(full - others * kShadowUnit, 0.0);
    }
  });
}

LightSeeker::LightSeeker(const Parameters& parameters, const ShadowGrid& shadow, int step)
    : shadow_(shadow),
      radius_((parameters.r.at(step) + kConeSlack) * shadow.voxel_size()),
      min_cosine_(std::cos(radians(parameters.theta_deg.at(step) / 2.0)) - kConeSlack),
      // The apex may be half a voxel off the middle of its own.
      reach_(static_cast<int>(std::floor(parameters.r.at(step) + 0.5))),
      tie_(parameters.tie) {}

Vec3 LightSeeker::best_direction(const Vec3& apex, const Vec3& axis) const {
  const int edge = 2 * reach_ + 1;
  thread_local std::vector<Shadow> values;
  values.resize(static_cast<std::size_t>(edge * edge * edge));
  const Coord own = shadow_.voxel_of(apex);
  const Coord low = own - reach_;
  shadow_.gather(low, edge, values);

  Shadow least = std::numeric_limits<Shadow>::max();
  Vec3 sum(0.0);
  const Shadow* value = values.data();
  for (int x = low.x; x < low.x + edge; ++x) {
    for (int y = low.y; y < low.y + edge; ++y) {
      for (int z = low.z; z < low.z + edge; ++z) {
        const Shadow s = *value++;
        if (s > least || Coord(x, y, z) == own) continue;
        const Vec3 towards = Vec3(x, y, z) * shadow_.voxel_size() - apex;
        const double distance = glm::length(towards);
        if (distance > radius_ || glm::dot(towards, axis) < min_cosine_ * distance) continue;
        if (s < least) {
          least = s;
          sum = Vec3(0.0);
        } else if (tie_ == Tie::first) {
          continue;
        }
        sum += towards / distance;
      }
    }
  }
  return normalized_or(sum, axis);
}

}  // namespace ramify::growth
