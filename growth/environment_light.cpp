#include "growth/environment_light.h"

#include <algorithm>
#include <limits>
#include <span>

#include "common/base/parallel.h"

namespace ramify::growth {
namespace {

// Centres on the very edge of the cone belong to it, whichever way rounding goes; buds keep their directions
// in single precision.
constexpr double kConeSlack = 1e-6;

constexpr std::size_t kBudsPerTask = 4096;
constexpr std::size_t kReadAhead = 16;

/// The first of so many values; those before are lost.
template <class T>
T* with_room(std::vector<T>& values, std::size_t count) {
  if (values.size() < count) values.resize(2 * count);
  return values.data();
}

}  // namespace

void sense_light(const Plant& plant, const Parameters& world, const TreeParameters& tree,
                 const LightField& field, int step, MappedVector<double>& light) {
  const double full = tree.C.at(step);
  const ShadowGrid& grid = field.grid();
  const auto additive = [&](const Bud& bud) {
    const bool casts_itself = world.casters == Casters::buds ||
                              (bud.node != 0 && has_leaves(world, plant.birth_step[bud.node], step));
    const Shadow others = grid.at(bud.site) - (casts_itself ? grid.own_shadow() : 0);
    return std::max(full - others * kShadowUnit, 0.0);
  };
  const auto multiplicative = [&](const Bud& bud) { return full * field.light(plant.position[bud.node]); };

  set_size(light, plant.buds.size());
  const auto sense = [&](const auto& exposure) {
    parallel_for(plant.buds.size(), kBudsPerTask, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        // Buds stand in the order of their birth, their voxels anywhere: reading ahead hides the wait.
        if (i + kReadAhead < end) grid.prefetch(plant.buds[i + kReadAhead].site);
        light[i] = exposure(plant.buds[i]);
      }
    });
  };
  world.shadow == ShadowModel::additive ? sense(additive) : sense(multiplicative);
}

LightSeeker::LightSeeker(const TreeParameters& tree, const LightField& field, int step)
    : field_(field),
      from_(tree.optimal_from),
      radius_(tree.r.at(step) + kConeSlack),
      min_cosine_(std::cos(radians(tree.theta_deg.at(step) / 2.0)) - kConeSlack),
      sine_(std::sin(radians(tree.theta_deg.at(step) / 2.0))),
      tie_(tree.tie),
      probe_radius_(tree.probe_radius.at(step)),
      gradient_max_(tree.gradient_max.at(step)) {}

Vec3 LightSeeker::best_direction(const Vec3& apex, const Vec3& axis) const {
  return from_ == OptimalFrom::gradient ? gradient(apex) : darkest_free(apex, axis);
}

void LightSeeker::prefetch(const Vec3& apex, const Vec3& axis) const {
  // Of the voxels around the middle of the cone two along y, and all along z, share a line of the cache.
  const ShadowGrid& grid = field_.grid();
  const Coord middle = grid.voxel_of(apex + axis * (0.7 * radius_ * grid.voxel_size()));
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; y += 2) grid.prefetch(middle + Coord(x, y, 0));
  }
}

Vec3 LightSeeker::gradient(const Vec3& apex) const {
  const Vec3 slope = field_.slope(apex, probe_radius_);
  const double length = glm::length(slope);
  return length > gradient_max_ ? slope * (gradient_max_ / length) : slope;
}

bool LightSeeker::is_in_cone(double square, double along) const {
  const bool is_wide = min_cosine_ < 0.0;
  const bool is_near_axis = (along * along >= min_cosine_ * min_cosine_ * square) != is_wide;
  return (square <= radius_ * radius_) &
         (is_wide ? (along >= 0.0) | is_near_axis : (along >= 0.0) & is_near_axis);
}

/// The voxels whose centres lie within the cone, but for `own`, which holds the apex; `place` is that in
/// units of voxels. Valid until the thread asks again.
std::span<Coord> LightSeeker::find_in_cone(const Vec3& place, const Coord& own, const Vec3& axis) const {
  // The box around the cone and the ball's cap that closes it.
  Coord low;
  Coord high;
  for (int i = 0; i < 3; ++i) {
    const double sine = std::sqrt(std::max(0.0, 1.0 - axis[i] * axis[i]));
    const double turned = sine_ * sine;
    const double farthest = axis[i] >= min_cosine_ ? 1.0 : min_cosine_ * axis[i] + turned;
    const double nearest = -axis[i] >= min_cosine_ ? -1.0 : min_cosine_ * axis[i] - turned;
    low[i] = static_cast<int>(std::ceil(place[i] + radius_ * std::min(nearest, 0.0) - kConeSlack));
    high[i] = static_cast<int>(std::floor(place[i] + radius_ * std::max(farthest, 0.0) + kConeSlack));
  }

  // Gathered without a branch on each voxel: whether it is in the cone is hard to foretell.
  thread_local std::vector<Coord> in_cone;
  const Coord size = glm::max(high - low + 1, Coord(0));
  Coord* const voxels =
      with_room(in_cone, std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z) + 1);
  std::size_t count = 0;
  for (int x = low.x; x <= high.x; ++x) {
    const double dx = x - place.x;
    for (int y = low.y; y <= high.y; ++y) {
      const double dy = y - place.y;
      const double square_xy = dx * dx + dy * dy;
      if (square_xy > radius_ * radius_) continue;
      const double along_xy = dx * axis.x + dy * axis.y;
      const bool is_own_column = (x == own.x) & (y == own.y);
      for (int z = low.z; z <= high.z; ++z) {
        const double dz = z - place.z;
        const bool is_own = is_own_column & (z == own.z);
        voxels[count] = {x, y, z};
        count += is_in_cone(square_xy + dz * dz, along_xy + dz * axis.z) & !is_own;
      }
    }
  }
  return {voxels, count};
}

/// The mean direction of the least shaded voxels whose centres lie within the cone, but for the voxel of
/// `apex` itself; `axis` where there are none or they cancel out. In units of voxels.
Vec3 LightSeeker::darkest_free(const Vec3& apex, const Vec3& axis) const {
  const Vec3 place = apex / field_.grid().voxel_size();
  const std::span<Coord> voxels = find_in_cone(place, field_.grid().voxel_of(apex), axis);

  thread_local std::vector<Shadow> shade_of_each;
  Shadow* const shades = with_room(shade_of_each, voxels.size());
  LeafReader reader = field_.grid().reader();
  Shadow least = std::numeric_limits<Shadow>::max();
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    shades[i] = field_.shade(voxels[i], reader.at(voxels[i]));
    least = std::min(least, shades[i]);
  }
  // Which have the least is as hard to foretell.
  std::size_t ties = 0;
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    voxels[ties] = voxels[i];
    ties += shades[i] == least;
  }
  if (tie_ == Tie::first) ties = std::min<std::size_t>(ties, 1);
  Vec3 sum(0.0);
  for (const Coord& voxel : voxels.first(ties)) sum += glm::normalize(Vec3(voxel) - place);
  return normalized_or(sum, axis);
}

}  // namespace ramify::growth
