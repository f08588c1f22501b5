#include "growth/simulation.h"

#include <algorithm>

#include "common/base/parallel.h"
#include "growth/allocation.h"
#include "growth/cutting.h"
#include "growth/environment_light.h"
#include "growth/environment_space.h"
#include "growth/phyllotaxis.h"
#include "growth/pruning.h"
#include "growth/shedding.h"
#include "growth/shoots.h"

namespace ramify::growth {
namespace {

// Holes are closed when they are this share of an array: copying often costs more than skipping them.
constexpr double kHoleShare = 0.1;

constexpr std::size_t kReadAhead = 16;

// Shoots that are traced before they are built: so many that all threads have enough to do, so few that their
// nodes stay in the cache in between. No shoot sees another of its step, whatever their number.
constexpr std::size_t kShootsAtOnce = 4096;

Penumbra penumbra_of(const Parameters& world) {
  return {.model = world.shadow,
          .a = world.a,
          .b = world.b,
          .q_max = world.q_max,
          .sun_direction = glm::normalize(world.sun_direction)};
}

/// The voxel a node of the plant casts its shadow from.
Coord caster_of(const Plant& plant, std::uint32_t node, const Parameters& world, const ShadowGrid& shadow) {
  const bool casts_from_start = world.shadow == ShadowModel::multiplicative;
  return shadow.voxel_of(plant.position[casts_from_start ? plant.parent[node] : node]);
}

void allocate(GrowingTree& tree, int step) {
  switch (tree.place.allocation) {
    case Allocation::priority:
      allocate_priority(tree.plant, tree.light, tree.sums, tree.place, step, tree.vigour);
      break;
    case Allocation::borchert_honda:
      allocate_borchert_honda(tree.plant, tree.light, tree.sums, tree.place, step, tree.vigour);
      break;
  }
}

}  // namespace

Simulation::Simulation(const Parameters& world, bool with_history)
    : world_(world),
      shadow_(penumbra_of(world), world.voxel_edge()),
      field_(shadow_, world.shadow, world.seed),
      barriers_(world) {
  const std::vector<TreePlace> places = world.planted();
  const bool is_light = world.environment == Environment::light;
  if (!is_light) markers_.emplace(scattered_markers(world, places));
  for (const Obstacle& obstacle : world.obstacles) {
    if (obstacle.shadow <= 0.0 || !is_light) continue;
    const auto amount = static_cast<Shadow>(std::lround(obstacle.shadow / kShadowUnit));
    shadow_.darken(voxels_inside(obstacle.volume, shadow_.voxel_size()), amount);
  }
  for (const TreePlace& place : places) {
    const Coord voxel = shadow_.voxel_of(place.position);
    GrowingTree& tree = trees_.emplace_back();
    tree.place = place;
    tree.plant = seedling(place, is_light ? shadow_.site_of(voxel) : 0);
    if (is_light && world.casters == Casters::buds) changes_.added.push_back(voxel);
    if (with_history) tree.history.emplace().record(tree.plant, 0);
    if (markers_) markers_->occupy(tree.plant.position, occupied_radius(place, 0));
  }
  shadow_.cast(changes_.added);
  changes_.added.clear();
}

std::size_t Simulation::internode_count() const {
  std::size_t count = 0;
  for (const GrowingTree& tree : trees_) count += tree.plant.internode_count();
  return count;
}

void Simulation::sense() {
  const int step = step_ + 1;
  if (markers_) {
    sense_space(trees_, *markers_, step, space_search_);
  } else {
    for (GrowingTree& tree : trees_) {
      sense_light(tree.plant, world_, tree.place, field_, step, tree.light);
    }
  }
  stopwatch_.lap("environment");
  for (GrowingTree& tree : trees_) {
    sum_light(tree.plant, tree.light, tree.sums);
    tree.resource = root_vigour(tree.sums, tree.place, step);
    const std::vector<std::uint32_t> shaded = shaded_axes(tree.plant, tree.sums, tree.place, step);
    side_by_side([&] { allocate(tree, step); }, [&] { tree.shaded = nodes_beyond(tree.plant, shaded); });
  }
  stopwatch_.lap("allocation");
}

bool Simulation::has_room() const {
  // A metamer takes a vigour of 1, so there cannot be more of them than there is resource.
  double most = static_cast<double>(internode_count());
  for (const GrowingTree& tree : trees_) most += tree.resource;
  if (most <= 0.99 * world_.max_internodes) return true;
  double planned = static_cast<double>(internode_count());
  for (const GrowingTree& tree : trees_) planned += planned_metamers(tree.vigour, tree.place, step_ + 1);
  return planned <= world_.max_internodes;
}

bool Simulation::advance() {
  sense();
  if (!has_room()) return false;
  const int step = step_ + 1;
  barriers_.set_step(step);

  shed_starved(step);
  for (GrowingTree& tree : trees_) extend(tree, step);
  stopwatch_.lap("shoots");

  lose(step);
  side_by_side([&] { shadow_.change(changes_.added, changes_.removed); }, [&] { close_holes(); });
  changes_.added.clear();
  changes_.removed.clear();
  stopwatch_.lap("shadow and shedding");
  step_ = step;
  return true;
}

void Simulation::lose(int step) {
  for (GrowingTree& tree : trees_) cut(tree, tree.shaded, step);
  prune(step);
  if (world_.leaf_lifespan > 0) {
    for (const GrowingTree& tree : trees_) drop_leaves(tree, step);
  }
  for (GrowingTree& tree : trees_) {
    // Those that cast nothing go without a word when holes are closed.
    if (world_.casters == Casters::buds) lose_buds(tree.plant);
    abort_buds(tree.plant, world_, tree.place, shadow_, step, changes_);
  }
}

void Simulation::close_holes() {
  for (GrowingTree& tree : trees_) compact(tree.plant, kHoleShare);
}

void Simulation::extend(GrowingTree& tree, int step) {
  Plant& plant = tree.plant;
  const Guides guides{world_, tree.place, tree.place.seed, barriers_, field_, tree.light, tree.space};
  ShootPlanner planner(plant, tree.vigour, tree.place, step);
  const std::size_t first = plant.node_count();
  std::vector<Shoot> shoots = planner.next(kShootsAtOnce);
  while (!shoots.empty()) {
    Traces traces;
    std::vector<Shoot> next;
    side_by_side([&] { traces = trace_shoots(shoots, plant, guides, step); },
                 [&] { next = planner.next(kShootsAtOnce); });
    build_shoots(plant, shoots, traces, world_, tree.place, shadow_, step, changes_);
    shoots = std::move(next);
  }
  if (tree.place.tip_bud == TipBud::terminal && buds_per_node(tree.place) > 1) sort_buds(plant);
  follow_growth(plant, first, tree.shaded);
  if (tree.history) tree.history->record(plant, first);
  if (markers_) markers_->occupy(std::span(plant.position).subspan(first), occupied_radius(tree.place, step));
}

void Simulation::shed_starved(int step) {
  for (GrowingTree& tree : trees_) {
    const auto starved = starved_internodes(tree.plant, tree.sums, tree.vigour, tree.place, step);
    if (starved.empty()) continue;
    cut(tree, nodes_beyond(tree.plant, starved), step);
    lose_buds(tree.plant);
  }
}

void Simulation::prune(int step) {
  for (const PruneEvent& event : world_.prune) {
    if (!is_due(event, step)) continue;
    for (GrowingTree& tree : trees_) {
      cut(tree, nodes_beyond(tree.plant, pruned_internodes(tree.plant, event)), step);
    }
  }
}

/// The metamers whose leaves have had their time cease to cast shadow.
void Simulation::drop_leaves(const GrowingTree& tree, int step) {
  if (world_.casters != Casters::metamers || markers_) return;
  const Plant& plant = tree.plant;
  const int birth_step = step - world_.leaf_lifespan;
  if (birth_step < 1) return;
  const auto [first, last] = std::equal_range(plant.birth_step.begin(), plant.birth_step.end(), birth_step);
  for (auto it = first; it != last; ++it) {
    const auto node = static_cast<std::uint32_t>(it - plant.birth_step.begin());
    if (!plant.is_cut(node)) changes_.removed.push_back(caster_of(plant, node, world_, shadow_));
  }
}

void Simulation::cut(GrowingTree& tree, const std::vector<std::uint32_t>& nodes, int step) {
  if (nodes.empty()) return;
  Plant& plant = tree.plant;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i + kReadAhead < nodes.size()) __builtin_prefetch(&plant.position[nodes[i + kReadAhead]]);
    const std::uint32_t node = nodes[i];
    if (tree.history) tree.history->shed_step[plant.id[node]] = static_cast<std::uint16_t>(step);
    const bool casts =
        !markers_ && world_.casters == Casters::metamers && has_leaves(world_, plant.birth_step[node], step);
    if (casts) changes_.removed.push_back(caster_of(plant, node, world_, shadow_));
  }
  cut_away(plant, nodes);
}

/// Buds on wood that is cut away die.
void Simulation::lose_buds(Plant& plant) {
  for (Bud& bud : plant.buds) {
    if (bud.is_dead() || !plant.is_cut(bud.node)) continue;
    if (!markers_ && world_.casters == Casters::buds) {
      changes_.removed.push_back(shadow_.voxel_of(plant.position[bud.node]));
    }
    bud.node = kNone;
  }
}

}  // namespace ramify::growth
