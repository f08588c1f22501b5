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
  search.buds.clear();
  search.ends.clear();
  for (GrowingTree& tree : trees) {
    set_size(tree.light, tree.plant.buds.size());
    set_size(tree.space, tree.plant.buds.size());
    std::fill(tree.light.begin(), tree.light.end(), 0.0);
    const double radius = tree.place.r.at(step) * tree.place.internode_length.at(step);
    const double min_cosine = std::cos(radians(tree.place.theta_deg.at(step) / 2.0));
    for (std::size_t i = 0; i < tree.plant.buds.size(); ++i) {
      const Bud& bud = tree.plant.buds[i];
      if (bud.is_blind) continue;
      const Vec3& position = tree.plant.position[bud.node];
      if (markers.is_barren(position)) continue;
      seekers.push_back({position, Vec3(tree.plant.bud_direction[i]), radius, min_cosine});
      search.buds.push_back(static_cast<std::uint32_t>(i));
    }
    search.ends.push_back(seekers.size());
  }

  markers.claim(seekers, search.claims);
  std::size_t next = 0;
  for (std::size_t i = 0; i < trees.size(); ++i) {
    GrowingTree& tree = trees[i];
    const bool is_final = sight_never_widens(tree.place, step);
    for (; next < search.ends[i]; ++next) {
      const Claim& claim = search.claims[next];
      const std::uint32_t bud = search.buds[next];
      if (claim.markers > 0) {
        tree.light[bud] = 1.0;
        tree.space[bud] = Vec3f(claim.direction);
      }
      tree.plant.buds[bud].is_blind = is_final && claim.is_blind;
    }
  }
}

}  // namespace ramify::growth
