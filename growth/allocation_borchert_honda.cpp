#include "growth/allocation.h"

namespace ramify::growth {

double root_vigour(const LightSums& sums, const Parameters& parameters, int step) {
  return parameters.alpha0.at(step) + parameters.alpha.at(step) * sums.total(0);
}

void allocate_borchert_honda(const Plant& plant, const std::vector<double>& light, const LightSums& sums,
                             const Parameters& parameters, int step, std::vector<double>& vigour) {
  const double lambda = parameters.lambda.at(step);
  // A side without light leaves all to the other, even where lambda is 0 or 1.
  const auto main_weight = [&](std::size_t node) { return sums.lateral[node] > 0.0 ? lambda : 1.0; };
  const auto lateral_weight = [&](std::size_t node) { return sums.main[node] > 0.0 ? 1.0 - lambda : 1.0; };

  // What a node passes on for each unit of weighted light beyond it.
  std::vector<double> rate(plant.node_count(), 0.0);
  const auto set_rate = [&](std::size_t node, double received) {
    const double demand = main_weight(node) * sums.main[node] + lateral_weight(node) * sums.lateral[node];
    rate[node] = demand > 0.0 ? received / demand : 0.0;
  };
  const auto share = [&](std::size_t node, bool is_main, double light_beyond) {
    return rate[node] * (is_main ? main_weight(node) : lateral_weight(node)) * light_beyond;
  };

  set_rate(0, root_vigour(sums, parameters, step));
  for (std::size_t node = 1; node < plant.node_count(); ++node) {
    if (plant.shed_step[node] != kAlive) continue;
    const std::uint32_t parent = plant.parent[node];
    set_rate(node, share(parent, plant.axis[node] == plant.axis[parent], sums.total(node)));
  }

  vigour.resize(plant.buds.size());
  for (std::size_t i = 0; i < plant.buds.size(); ++i) {
    const Bud& bud = plant.buds[i];
    vigour[i] = share(bud.node, bud.is_terminal, light[i]);
  }
}

}  // namespace ramify::growth
