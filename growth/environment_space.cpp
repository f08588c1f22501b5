#include "growth/environment_space.h"

#include <algorithm>

namespace ramify::growth {
namespace {

/// The greatest value a schedule ever has.
double greatest(const Schedule& schedule) {
  double value = schedule.points().front().second;
  for (const auto& point : schedule.points()) value = std::max(value, point.second);
  return value;
}

/// Whether a schedule never rises above its value at `step` from then on.
bool never_rises(const Schedule& schedule, int step) {
  const double now = schedule.at(step);
  return std::all_of(schedule.points().begin(), schedule.points().end(),
                     [&](const auto& point) { return point.first <= step || point.second <= now; });
}

/// Whether what a bud does not see in `step` it will not see later either.
bool sight_never_widens(const TreeParameters& tree, int step) {
  return never_rises(tree.r, step) && never_rises(tree.theta_deg, step) &&
         never_rises(tree.internode_length, step);
}

}  // namespace

Markers scattered_markers(const Parameters& world, const std::vector<TreePlace>& places) {
  double reach = 0.0;
  for (const TreePlace& place : places) {
    reach = std::max(reach, greatest(place.r) * greatest(place.internode_length));
  }
  const double volume = volume_of(world.markers.volume);
  return Markers(Solid(world.markers.volume), volume, world.markers.density, world.seed, reach);
}

double occupied_radius(const TreeParameters& tree, int step) {
  return tree.rho.at(step) * tree.internode_length.at(step);
}

void sense_space(std::vector<GrowingTree>& trees, Markers& markers, int step, SpaceSearch& search) {
  std::vector<Seeker>& seekers = search.seekers;
  seekers.clear();
  for (GrowingTree& tree : trees) {
    tree.light.assign(tree.plant.buds.size(), 0.0);
    tree.space.resize(tree.plant.buds.size());
    const double radius = tree.place.r.at(step) * tree.place.internode_length.at(step);
    const double min_cosine = std::cos(radians(tree.place.theta_deg.at(step) / 2.0));
    for (std::size_t i = 0; i < tree.plant.buds.size(); ++i) {
      const Bud& bud = tree.plant.buds[i];
      const Vec3f& direction = tree.plant.bud_direction[i];
      tree.space[i] = direction;
      if (bud.is_blind) continue;
      const Vec3& position = tree.plant.position[bud.node];
      if (markers.is_barren(position)) continue;
      seekers.push_back({position, Vec3(direction), radius, min_cosine});
      tree.light[i] = 1.0;  // that it looks; for the second pass
    }
  }

  markers.claim(seekers, search.claims);
  auto claim = search.claims.cbegin();
  for (GrowingTree& tree : trees) {
    const bool is_final = sight_never_widens(tree.place, step);
    for (std::size_t i = 0; i < tree.light.size(); ++i) {
      if (tree.light[i] == 0.0) continue;
      tree.light[i] = claim->markers > 0 ? 1.0 : 0.0;
      tree.space[i] = Vec3f(claim->direction);
      tree.plant.buds[i].is_blind = is_final && claim->is_blind;
      ++claim;
    }
  }
}

}  // namespace ramify::growth
