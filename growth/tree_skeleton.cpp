#include "growth/tree_skeleton.h"

#include "common/base/parallel.h"
#include "common/skeleton/passes.h"

namespace ramify::growth {
namespace {

template <class Values>
void release(Values& values) {
  Values().swap(values);
}

/// Sums of a value of buds over each node's subtree, a node of the skeleton: with a history 0 for shed ones.
std::vector<float> skeleton_sums(const GrowingTree& tree, const std::vector<double>& values) {
  const std::vector<double> sums = subtree_sums(tree.plant, values);
  if (!tree.history) return {sums.begin(), sums.end()};
  std::vector<float> result(tree.history->position.size(), 0.0f);
  for (std::size_t node = 0; node < sums.size(); ++node) {
    result[tree.plant.id[node]] = static_cast<float>(sums[node]);
  }
  return result;
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
  tree.sums = {};
  release(tree.space);
  compact(plant, 0.0);

  Skeleton skeleton;
  side_by_side([&] { skeleton.light = skeleton_sums(tree, tree.light); },
               [&] { skeleton.vigour = skeleton_sums(tree, tree.vigour); });
  release(tree.light);
  release(tree.vigour);
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
