#include "growth/allocation.h"

namespace ramify::growth {
namespace {

/// What the sides of a node ask for.
struct Sides {
  double main = 0.0;
  double lateral = 0.0;
};

/// n * (Q / n)^exponent of a side with n internodes and buds (SOT); Q itself where the exponent is 1.
double mean_demand(double light, std::uint32_t n, double exponent) {
  return n > 0 && light > 0.0 ? n * std::pow(light / n, exponent) : 0.0;
}

double node_demand(const LightSum& sum, double exponent) {
  return mean_demand(sum.total(), sum.internodes + sum.buds, exponent);
}

/// The demands at each node with demand = mean, where they do not add up like light.
std::vector<Sides> mean_demands(const Plant& plant, const std::vector<double>& light,
                                const std::vector<LightSum>& sums, double exponent) {
  std::vector<Sides> demands(plant.node_count());
  for (std::size_t i = 0; i < plant.buds.size(); ++i) {
    const Bud& bud = plant.buds[i];
    if (bud.is_dead()) continue;
    Sides& sides = demands[bud.node];
    (bud.is_terminal ? sides.main : sides.lateral) += mean_demand(light[i], 1, exponent);
  }
  for (std::size_t node = 1; node < plant.node_count(); ++node) {
    if (plant.is_cut(node)) continue;
    const std::uint32_t parent = plant.parent[node];
    Sides& sides = demands[parent];
    (plant.founds_axis[node] ? sides.lateral : sides.main) += node_demand(sums[node], exponent);
  }
  return demands;
}

/// Hands the root's resource up. `demands(node)` are the Sides of a node, `of_node(node)` and `of_bud(i)`
/// what a child node and a bud add to them.
template <class Demands, class OfNode, class OfBud>
void share(const Plant& plant, double at_root, double lambda, const Demands& demands, const OfNode& of_node,
           const OfBud& of_bud, std::vector<LightSum>& sums, std::vector<double>& vigour) {
  // A side without light leaves all to the other, even where lambda is 0 or 1.
  const auto weights = [&](const Sides& sides) {
    return Sides{sides.lateral > 0.0 ? lambda : 1.0, sides.main > 0.0 ? 1.0 - lambda : 1.0};
  };
  const auto set_rate = [&](std::size_t node, double received) {
    const Sides sides = demands(node);
    const Sides weight = weights(sides);
    const double demand = weight.main * sides.main + weight.lateral * sides.lateral;
    sums[node].rate = demand > 0.0 ? received / demand : 0.0;
  };
  const auto passed = [&](std::size_t node, bool is_main, double demand) {
    const Sides weight = weights(demands(node));
    return sums[node].rate * (is_main ? weight.main : weight.lateral) * demand;
  };

  vigour.resize(plant.buds.size());
  std::size_t i = 0;
  for (std::size_t node = 0; node < plant.node_count(); ++node) {
    const std::uint32_t parent = plant.parent[node];
    if (node == 0) set_rate(node, at_root);
    if (parent != kNone) set_rate(node, passed(parent, !plant.founds_axis[node], of_node(node)));
    for (; i < plant.buds.size() && (plant.buds[i].is_dead() || plant.buds[i].node == node); ++i) {
      const Bud& bud = plant.buds[i];
      vigour[i] = bud.is_dead() ? 0.0 : passed(node, bud.is_terminal, of_bud(i));
    }
  }
}

}  // namespace

double root_vigour(const std::vector<LightSum>& sums, const TreeParameters& tree, int step) {
  return tree.alpha0.at(step) + tree.alpha.at(step) * sums[0].total();
}

void allocate_borchert_honda(const Plant& plant, const std::vector<double>& light,
                             std::vector<LightSum>& sums, const TreeParameters& tree, int step,
                             std::vector<double>& vigour) {
  const double at_root = root_vigour(sums, tree, step);
  const double lambda = tree.lambda.at(step);
  if (tree.demand == Demand::sum) {
    share(
        plant, at_root, lambda,
        [&](std::size_t node) {
          return Sides{sums[node].main, sums[node].lateral};
        },
        [&](std::size_t node) { return sums[node].total(); }, [&](std::size_t bud) { return light[bud]; },
        sums, vigour);
    return;
  }
  const double exponent = tree.demand_exponent.at(step);
  const std::vector<Sides> demands = mean_demands(plant, light, sums, exponent);
  share(
      plant, at_root, lambda, [&](std::size_t node) { return demands[node]; },
      [&](std::size_t node) { return node_demand(sums[node], exponent); },
      [&](std::size_t bud) { return mean_demand(light[bud], 1, exponent); }, sums, vigour);
}

}  // namespace ramify::growth
