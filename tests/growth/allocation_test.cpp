#include "growth/allocation.h"

#include <numeric>

#include "common/base/rng.h"
#include "growth/simulation.h"
#include "tests/catch.h"
#include "tests/growth/plants.h"
#include "tests/growth/runs.h"

using namespace ramify;
using namespace ramify::growth;
using namespace ramify::test;

namespace {

/// A trunk of one internode with a terminal and an axillary bud, and a lateral axis of one internode with a
/// terminal bud on the trunk's first node.
struct Fork {
  Plant plant;
  MappedVector<double> light = {0.5, 0.25, 1.0};  // terminal, axillary, lateral's terminal
  LightSums sums;

  Fork() {
    plant = test::seedling();
    add_node(plant, 0, 0);
    add_node(plant, 1, 1);
    plant.buds = {{.node = 1, .is_terminal = true},
                  {.node = 1, .is_terminal = false},
                  {.node = 2, .is_terminal = true}};
    sum_light(plant, light, sums);
  }
};

double sum(const MappedVector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

bool is_near(double a, double b) {
  return std::abs(a - b) <= 1e-12 * std::max(1.0, std::abs(b));
}

}  // namespace

TEST_CASE("light sums: each node has what its buds and all beyond them get") {
  const Fork fork;
  CHECK(fork.sums.total(0) == 1.75);
  CHECK(fork.sums.light[1][kMain] == 0.5);
  CHECK(fork.sums.light[1][kLateral] == 1.25);
  CHECK(bud_counts(fork.plant)[0] == 3);
  CHECK(bud_counts(fork.plant)[2] == 1);
  CHECK(fork.sums.internodes[1] == 2);
}

TEST_CASE("Borchert-Honda: a fork shares by lambda times light") {
  Fork fork;
  Parameters parameters;
  parameters.alpha = 2.0;
  parameters.alpha0 = 0.5;
  for (const double lambda : {0.0, 0.3, 0.5, 0.7, 1.0}) {
    parameters.lambda = lambda;
    MappedVector<double> v;
    sum_light(fork.plant, fork.light, fork.sums);
    allocate_borchert_honda(fork.plant, fork.light, fork.sums, parameters, 1, v);
    const double root = 0.5 + 2.0 * 1.75;
    const double demand = lambda * 0.5 + (1 - lambda) * 1.25;
    CHECK(is_near(v[0], root * lambda * 0.5 / demand));
    CHECK(is_near(v[1], root * (1 - lambda) * 0.25 / demand));
    CHECK(is_near(v[2], root * (1 - lambda) * 1.0 / demand));
    CHECK(is_near(sum(v), root));
  }
}

TEST_CASE("priority: the weights of Palubicki et al. for ten items") {
  const std::vector<double> expected = {.8012, .6024, .4036, .2048, .006, .006, .006, .006, .006, .006};
  for (std::size_t i = 1; i <= 10; ++i) {
    CHECK(std::abs(priority_weight(i, 10, 1.0, 0.006, 0.5) - expected[i - 1]) < 1e-12);
  }
}

TEST_CASE("priority: weights never rise, fall in a straight line up to kappa N and stay at w_min") {
  for (const double kappa : {0.0, 0.2, 0.35, 0.5, 1.0}) {
    for (std::size_t n = 1; n < 40; ++n) {
      for (std::size_t i = 1; i < n; ++i) {
        const double weight = priority_weight(i, n, 2.0, 0.01, kappa);
        const double next = priority_weight(i + 1, n, 2.0, 0.01, kappa);
        CHECK(next <= weight);
        const double range = kappa * double(n);
        if (double(i) >= range) CHECK(weight == 0.01);
        if (double(i) < range) CHECK(is_near(weight, 2.0 - 1.99 * double(i) / range));
      }
    }
  }
}

TEST_CASE("priority: with few items all weigh the same") {
  for (std::size_t n = 1; n <= 2; ++n) {
    for (std::size_t i = 1; i <= n; ++i) CHECK(priority_weight(i, n, 1.0, 0.006, 0.5) == 0.006);
  }
}

TEST_CASE("priority: the terminal bud leads whatever its light, until it no longer does") {
  Fork fork;
  Parameters parameters;
  parameters.kappa = 1.0;
  MappedVector<double> v;
  const auto weight = [&](std::size_t place) { return priority_weight(place, 3, 1.0, 0.006, 1.0); };

  // Terminal (0.5), then by mean light: the lateral axis (1.0) and the axillary bud (0.25).
  allocate_priority(fork.plant, fork.light, fork.sums, parameters, 1, v);
  double demand = 0.5 * weight(1) + 1.0 * weight(2) + 0.25 * weight(3);
  CHECK(is_near(v[0], 3.5 * 0.5 * weight(1) / demand));
  CHECK(is_near(v[2], 3.5 * 1.0 * weight(2) / demand));
  CHECK(is_near(sum(v), 3.5));

  // Released: the better lit lateral goes first.
  parameters.terminal_first_until = 4;
  allocate_priority(fork.plant, fork.light, fork.sums, parameters, 5, v);
  demand = 1.0 * weight(1) + 0.5 * weight(2) + 0.25 * weight(3);
  CHECK(is_near(v[2], 3.5 * 1.0 * weight(1) / demand));
}

TEST_CASE("priority: among equals the one nearest the tip leads, the terminal bud before its axillary") {
  Plant plant = test::seedling();
  add_node(plant, 0, 0);
  add_node(plant, 1, 0);
  plant.buds = {
      {.node = 1, .is_terminal = false}, {.node = 2, .is_terminal = false}, {.node = 2, .is_terminal = true}};
  const MappedVector<double> light = {1.0, 1.0, 1.0};
  LightSums sums;
  sum_light(plant, light, sums);
  Parameters parameters;
  parameters.kappa = 1.0;
  parameters.terminal_first_until = 0;
  MappedVector<double> v;
  allocate_priority(plant, light, sums, parameters, 1, v);
  CHECK(v[2] > v[1]);
  CHECK(v[1] > v[0]);
}

TEST_CASE("allocation: in the dark nobody gets anything") {
  Fork fork;
  fork.light = {0.0, 0.0, 0.0};
  sum_light(fork.plant, fork.light, fork.sums);
  Parameters parameters;
  parameters.alpha0 = 3.0;
  MappedVector<double> v;
  allocate_borchert_honda(fork.plant, fork.light, fork.sums, parameters, 1, v);
  CHECK(v == MappedVector<double>{0, 0, 0});
  sum_light(fork.plant, fork.light, fork.sums);
  allocate_priority(fork.plant, fork.light, fork.sums, parameters, 1, v);
  CHECK(v == MappedVector<double>{0, 0, 0});
}

TEST_CASE("Borchert-Honda: a demand by mean light counts n (Q / n)^exponent a side, and 1 is the sum's") {
  Fork fork;
  Parameters parameters;
  parameters.lambda = 0.6;
  MappedVector<double> by_sum, v;
  allocate_borchert_honda(fork.plant, fork.light, fork.sums, parameters, 1, by_sum);
  sum_light(fork.plant, fork.light, fork.sums);
  parameters.demand = Demand::mean;
  allocate_borchert_honda(fork.plant, fork.light, fork.sums, parameters, 1, v);
  for (std::size_t i = 0; i < v.size(); ++i) CHECK(is_near(v[i], by_sum[i]));

  parameters.demand_exponent = 3.0;
  allocate_borchert_honda(fork.plant, fork.light, fork.sums, parameters, 1, v);
  // The lateral has an internode and a bud, n = 2, the others are buds, n = 1.
  const double main = 0.6 * std::pow(0.5, 3);
  const double bud = 0.4 * std::pow(0.25, 3);
  const double lateral = 0.4 * 2 * std::pow(0.5, 3);
  CHECK(is_near(v[0], 3.5 * main / (main + bud + lateral)));
  CHECK(is_near(v[1], 3.5 * bud / (main + bud + lateral)));
  CHECK(is_near(v[2], 3.5 * lateral / (main + bud + lateral)));
}

namespace {

/// What the buds of each tree are offered is what its root has, at every step.
void check_conservation(const Parameters& parameters) {
  Simulation simulation(parameters);
  while (simulation.step() < parameters.steps) {
    REQUIRE(simulation.advance());
    simulation.sense();
    for (const GrowingTree& tree : simulation.trees()) {
      if (sum(tree.light) <= 0.0) continue;
      REQUIRE(std::abs(sum(tree.vigour) - tree.resource) <= 1e-9 * tree.resource);
    }
  }
}

}  // namespace

TEST_CASE("allocation: what the buds are offered is what the root has, at every step of every preset") {
  for (const std::string& preset : growth_presets()) {
    INFO(preset);
    check_conservation(growth_parameters(preset));
  }
}

TEST_CASE("allocation: so it is with every model and demand, whatever the preset") {
  const std::vector<std::vector<std::string>> models = {
      {"growth.allocation=priority"},
      {"growth.allocation=borchert-honda", "growth.demand=sum"},
      {"growth.allocation=borchert-honda", "growth.demand=mean", "growth.demand_exponent=1.7"}};
  for (const std::string& preset : growth_presets()) {
    for (const std::vector<std::string>& model : models) {
      INFO(preset << " " << model.front() << " " << model.back());
      Parameters parameters = growth_parameters(preset, model);
      parameters.steps = std::min(parameters.steps, 12);
      check_conservation(parameters);
    }
  }
}

TEST_CASE("light sums: many buds at many nodes, shared among threads, add up as one after the other") {
  Plant plant = test::seedling();
  plant.buds.clear();
  plant.bud_direction.clear();
  Rng random = Rng::stream(3, Stream::dart, 0);
  MappedVector<double> light;
  MappedVector<double> expected = {0.0};
  for (std::uint32_t node = 1; node < 20000; ++node) {
    add_node(plant, node - 1, 0);
    expected.push_back(0.0);
    for (std::uint64_t bud = random.below(5); bud > 0; --bud) {
      add_bud(plant, {.node = node});
      light.push_back(random.uniform());
      expected[node] += light.back();
    }
  }
  MappedVector<double> alone = expected;
  for (std::size_t node = expected.size(); node-- > 1;) expected[node - 1] += expected[node];
  LightSums sums;
  for (int again = 0; again < 2; ++again)
    sum_light(plant, light, sums);  // nothing is left of the time before
  for (std::size_t node = 0; node < expected.size(); ++node) {
    REQUIRE(sums.light[node][kLateral] == alone[node]);
    REQUIRE(std::abs(sums.total(node) - expected[node]) <= 1e-9 * (1.0 + expected[node]));
  }
}
