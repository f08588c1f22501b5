#include "growth/plant.h"

#include "common/base/rng.h"
#include "common/skeleton/passes.h"

namespace ramify::growth {
namespace {

/// Sums of a value of buds over the subtree of each node.
std::vector<float> subtree_sums(const Plant& plant, const std::vector<double>& values) {
  std::vector<double> sums(plant.node_count(), 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) sums[plant.buds[i].node] += values[i];
  for (std::size_t node = sums.size(); node-- > 1;) sums[plant.parent[node]] += sums[node];
  return {sums.begin(), sums.end()};
}

}  // namespace

Plant seedling(const Parameters& parameters) {
  Plant plant;
  plant.position.push_back(Vec3(0.0));
  plant.parent.push_back(kNoParent);
  plant.axis.push_back(0);
  plant.birth_step.push_back(0);
  plant.shed_step.push_back(kAlive);

  Axis trunk;
  trunk.node_count = 1;
  const double azimuth = Rng::stream(parameters.seed, Stream::axis, 0).uniform(0.0, 2.0 * std::numbers::pi);
  trunk.reference = perpendicular_at(kUp, azimuth);
  plant.axes.push_back(trunk);
  plant.buds.push_back({.node = 0, .axis = 0, .is_terminal = true, .direction = kUp});
  return plant;
}

void sum_light(const Plant& plant, const std::vector<double>& light, LightSums& sums) {
  const std::size_t count = plant.node_count();
  sums.main.assign(count, 0.0);
  sums.lateral.assign(count, 0.0);
  sums.buds.assign(count, 0);
  sums.internodes.assign(count, 0);
  for (std::size_t i = 0; i < plant.buds.size(); ++i) {
    const Bud& bud = plant.buds[i];
    (bud.is_terminal ? sums.main : sums.lateral)[bud.node] += light[i];
    ++sums.buds[bud.node];
  }
  for (std::size_t node = count; node-- > 1;) {
    if (plant.shed_step[node] != kAlive) continue;
    const std::uint32_t parent = plant.parent[node];
    const bool is_main = plant.axis[node] == plant.axis[parent];
    (is_main ? sums.main : sums.lateral)[parent] += sums.total(node);
    sums.buds[parent] += sums.buds[node];
    sums.internodes[parent] += ++sums.internodes[node];
  }
}

Skeleton to_skeleton(const Plant& plant, const Parameters& parameters, const std::vector<double>& light,
                     const std::vector<double>& vigour) {
  Skeleton skeleton;
  skeleton.position = plant.position;
  skeleton.parent = plant.parent;
  skeleton.axis = plant.axis;
  skeleton.birth_step = plant.birth_step;
  skeleton.shed_step = plant.shed_step;
  skeleton.kind.assign(plant.node_count(), Kind::stem);
  skeleton.order.resize(plant.node_count());
  for (std::size_t node = 0; node < plant.node_count(); ++node) {
    skeleton.order[node] = plant.axes[plant.axis[node]].order;
  }
  skeleton.light = subtree_sums(plant, light);
  skeleton.vigour = subtree_sums(plant, vigour);
  assign_pipe_diameters(skeleton,
                        {.exponent = parameters.pipe_exponent, .tip_diameter = parameters.tip_diameter});
  return skeleton;
}

}  // namespace ramify::growth
