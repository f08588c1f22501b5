#include <algorithm>
#include <array>

#include "common/base/parallel.h"
#include "growth/allocation.h"

namespace ramify::growth {
namespace {

// Where nothing is asked for, any rate will do that makes nothing of nothing: no branch is needed.
constexpr double kLeastDemand = 1e-200;

constexpr std::size_t kBudsPerTask = 4096;

/// n * (Q / n)^exponent of a side with n internodes and buds (SOT); Q itself where the exponent is 1.
double mean_demand(double light, std::uint32_t n, double exponent) {
  return n > 0 && light > 0.0 ? n * std::pow(light / n, exponent) : 0.0;
}

/// What the sides of each node ask for with demand = mean, where that does not add up like light; `of_node`
/// says what a node asks for.
template <class OfNode>
std::vector<Sides> mean_demands(const Plant& plant, const MappedVector<double>& light, double exponent,
                                const OfNode& of_node) {
  std::vector<Sides> demands(plant.node_count(), Sides{});
  for (std::size_t i = 0; i < plant.buds.size(); ++i) {
    const Bud& bud = plant.buds[i];
    demands[bud.node][side_of(bud)] += mean_demand(light[i], 1, exponent);
  }
  for (std::size_t node = 1; node < plant.node_count(); ++node) {
    if (plant.is_cut(node)) continue;
    demands[plant.parent[node]][side_of(plant, node)] += of_node(node);
  }
  return demands;
}

/// Hands the root's resource up. `demands(node)` are those of a node's sides, `of_node(node)` and `of_bud(i)`
/// what a child node and a bud add to them. They become rates: what a side passes on for each unit of demand.
template <class OfSides, class OfNode, class OfBud>
void share(const Plant& plant, double at_root, double lambda, const OfSides& demands, const OfNode& of_node,
           const OfBud& of_bud, MappedVector<double>& vigour) {
  // A side whose sister has no light gets all, even where lambda is 0 or 1.
  const std::array<Sides, 2> weights{Sides{1.0, lambda}, Sides{1.0, 1.0 - lambda}};
  const auto weight = [&](const Sides& sides, Side side) { return weights[side][sides[1 - side] > 0.0]; };
  const auto set_rates = [&](std::size_t node, double received) {
    Sides& sides = demands(node);
    const Sides weighed{weight(sides, kMain), weight(sides, kLateral)};
    const double demand = weighed[kMain] * sides[kMain] + weighed[kLateral] * sides[kLateral];
    const double rate = received / std::max(demand, kLeastDemand);
    sides = {rate * weighed[kMain], rate * weighed[kLateral]};
  };
  const auto passed = [&](std::size_t node, Side side, double demand) {
    return demands(node)[side] * demand;
  };

  set_rates(0, at_root);
  for (std::size_t node = 1; node < plant.node_count(); ++node) {
    if (plant.is_cut(node)) continue;
    set_rates(node, passed(plant.parent[node], side_of(plant, node), of_node(node)));
  }
  set_size(vigour, plant.buds.size());
  parallel_for(plant.buds.size(), kBudsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Bud& bud = plant.buds[i];
      vigour[i] = passed(bud.node, side_of(bud), of_bud(i));
    }
  });
}

}  // namespace

double root_vigour(const LightSums& sums, const TreeParameters& tree, int step) {
  return tree.alpha0.at(step) + tree.alpha.at(step) * sums.total(0);
}

void allocate_borchert_honda(const Plant& plant, const MappedVector<double>& light, LightSums& sums,
                             const TreeParameters& tree, int step, MappedVector<double>& vigour) {
  const double at_root = root_vigour(sums, tree, step);
  const double lambda = tree.lambda.at(step);
  if (tree.demand == Demand::sum) {
    share(
        plant, at_root, lambda, [&](std::size_t node) -> Sides& { return sums.light[node]; },
        [&](std::size_t node) { return sums.total(node); }, [&](std::size_t bud) { return light[bud]; },
        vigour);
    return;
  }
  const double exponent = tree.demand_exponent.at(step);
  const std::vector<std::uint32_t> buds = bud_counts(plant);
  const auto of_node = [&](std::size_t node) {
    return mean_demand(sums.total(node), sums.internodes[node] + buds[node], exponent);
  };
  std::vector<Sides> demands = mean_demands(plant, light, exponent, of_node);
  share(
      plant, at_root, lambda, [&](std::size_t node) -> Sides& { return demands[node]; }, of_node,
      [&](std::size_t bud) { return mean_demand(light[bud], 1, exponent); }, vigour);
}

}  // namespace ramify::growth
