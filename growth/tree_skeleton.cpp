#include "growth/tree_skeleton.h"

#include <utility>

#include "common/skeleton/passes.h"

namespace ramify::growth {
namespace {

template <class Values>
void release(Values& values) {
  Values().swap(values);
}

enum Total : std::size_t { kLight, kVigour };

/// Light and resource of each node's subtree, summed up in the memory of the light sums, which are done with.
MappedVector<Sides> subtree_totals(GrowingTree& tree) {
  const Plant& plant = tree.plant;
  MappedVector<Sides> totals = std::move(tree.sums.light);
  totals.assign(plant.node_count(), Sides{});
  for (std::size_t i = 0; i < plant.buds.size(); ++i) {
    Sides& total = totals[plant.buds[i].node];
    total[kLight] += tree.light[i];
    total[kVigour] += tree.vigour[i];
  }
  for (std::size_t node = totals.size(); node-- > 1;) {
    if (plant.is_cut(node)) continue;
    totals[plant.parent[node]][kLight] += totals[node][kLight];
    totals[plant.parent[node]][kVigour] += totals[node][kVigour];
  }
  return totals;
}

/// One of the totals for each node of the skeleton: with a history 0 for shed ones.
std::vector<float> skeleton_values(const GrowingTree& tree, const MappedVector<Sides>& totals, Total which) {
  std::vector<float> values(tree.history ? tree.history->position.size() : totals.size(), 0.0f);
  for (std::size_t node = 0; node < totals.size(); ++node) {
    values[tree.history ? tree.plant.id[node] : node] = static_cast<float>(totals[node][which]);
  }
  return values;
}

void take_plant(Plant& plant, Skeleton& skeleton) {
  const std::size_t count = plant.node_count();
  skeleton.axis.resize(count);
  skeleton.order.resize(count);
  for (std::size_t node = 0; node < count; ++node) {
    const Axis& axis = plant.axes[plant.axis[node]];
    skeleton.axis[node] = axis.id;
    skeleton.order[node] = axis.order;
  }
  release(plant.axis);
  release(plant.axes);
  skeleton.position = std::move(plant.position);
  skeleton.parent = std::move(plant.parent);
  skeleton.birth_step.assign(plant.birth_step.begin(), plant.birth_step.end());
  skeleton.shed_step.assign(count, kAlive);
}

void take_history(History& history, Skeleton& skeleton) {
  skeleton.position = std::move(history.position);
  skeleton.parent = std::move(history.parent);
  skeleton.axis = std::move(history.axis_id);
  skeleton.order = std::move(history.order);
  skeleton.birth_step.assign(history.birth_step.begin(), history.birth_step.end());
  skeleton.shed_step.assign(history.shed_step.begin(), history.shed_step.end());
}

}  // namespace

Skeleton skeleton_of(GrowingTree tree, const Parameters& world) {
  static_assert(kNone == kNoParent);
  Plant& plant = tree.plant;
  release(tree.sums.internodes);
  release(tree.space);
  compact(plant, 0.0);

  Skeleton skeleton;
  MappedVector<Sides> totals = subtree_totals(tree);
  release(tree.light);
  release(tree.vigour);
  skeleton.light = skeleton_values(tree, totals, kLight);
  skeleton.vigour = skeleton_values(tree, totals, kVigour);
  release(totals);
  release(plant.buds);
  release(plant.bud_direction);
  const PipeModel pipe{.exponent = world.pipe_exponent, .tip_diameter = world.tip_diameter};
  if (tree.history) {
    take_history(*tree.history, skeleton);
    assign_pipe_diameters(skeleton, pipe);
  } else {
    take_plant(plant, skeleton);
    assign_pipe_diameters(skeleton, pipe, plant.lost_tips);
  }
  skeleton.kind.assign(skeleton.node_count(), Kind::stem);
  return skeleton;
}

}  // namespace ramify::growth
