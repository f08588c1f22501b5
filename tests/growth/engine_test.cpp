#include "growth/engine.h"

#include <map>
#include <numeric>
#include <sstream>

#include "common/base/parallel.h"
#include "common/format/skeleton_table.h"
#include "common/skeleton/passes.h"
#include "growth/simulation.h"
#include "tests/catch.h"
#include "tests/growth/runs.h"

using namespace ramify;
using namespace ramify::growth;
using namespace ramify::test;

namespace {

std::string table_of(const Skeleton& skeleton) {
  std::ostringstream out;
  write_skeleton_table(skeleton, out);
  return out.str();
}

Skeleton grow(const Parameters& parameters, bool with_history = false) {
  RunContext context;
  context.wants_history = with_history;
  return Engine::run(parameters, context).skeleton;
}

Parameters seeded(const std::string& preset, std::uint64_t seed, int steps = 0) {
  Parameters parameters = growth_parameters(preset);
  parameters.seed = seed;
  if (steps > 0) parameters.steps = steps;
  return parameters;
}

/// Environments, allocations and what else can be chosen, crossed.
std::vector<Parameters> variants() {
  std::vector<Parameters> family;
  const std::vector<std::vector<std::string>> environments = {
      {"growth.environment=light"},
      {"growth.environment=light", "growth.optimal_from=gradient", "growth.w_optimal=2"},
      {"growth.environment=light", "growth.shadow=multiplicative", "growth.alpha=3", "growth.max_metamers=2"},
      {"growth.environment=light", "growth.shadow=multiplicative", "growth.alpha=3", "growth.max_metamers=2",
       "growth.optimal_from=gradient", "growth.v_per=shoot", "growth.combine=slerp"},
      {"growth.environment=light", "growth.casters=buds", "growth.tip_bud=terminal", "growth.alpha=2.4"},
      {"growth.environment=space", "growth.r=4", "growth.markers.density=2000"}};
  const std::vector<std::vector<std::string>> allocations = {
      {"growth.allocation=priority"},
      {"growth.allocation=priority", "growth.terminal_first_until=2", "growth.sort_after=total"},
      {"growth.allocation=borchert-honda"},
      {"growth.allocation=borchert-honda", "growth.demand=mean", "growth.demand_exponent=1.5"}};
  const std::vector<std::vector<std::string>> habits = {
      {"growth.shed_threshold=0.2"},
      {"growth.shed_threshold=0.4", "growth.shed_by=vigour", "growth.phyllotaxis=opposite",
       "growth.jitter_deg=10"},
      {"growth.phyllotaxis=whorled", "growth.whorl_buds=3", "growth.leaf_lifespan=2",
       "growth.bud_lifespan=5"},
      {"growth.sympodial=true", "growth.phyllotaxis=alternate", "growth.shed_threshold=0.1",
       "growth.prune=[{step = 7, cut = \"outside\", volume = {shape = \"sphere\", radius = 1.0}}]"}};
  for (const auto& environment : environments) {
    for (const auto& allocation : allocations) {
      for (const auto& habit : habits) {
        std::vector<std::string> values = {"steps=8"};
        for (const auto* part : {&environment, &allocation, &habit}) {
          values.insert(values.end(), part->begin(), part->end());
        }
        family.push_back(growth_parameters("p09-fig7-50", values));
      }
    }
  }
  return family;
}

/// Presets with a number of steps that keeps the tree small, and all variants.
std::vector<Parameters> small_family() {
  std::vector<Parameters> family = variants();
  for (const std::string& preset : growth_presets()) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      Parameters parameters = seeded(preset, seed);
      parameters.steps = std::min(parameters.steps, 10);
      family.push_back(parameters);
    }
  }
  return family;
}

}  // namespace

TEST_CASE("growth: every preset and seed makes a sound skeleton, with and without history") {
  for (const Parameters& parameters : small_family()) {
    const Skeleton history = grow(parameters, true);
    CHECK(violations(history).empty());
    const Skeleton tree = grow(parameters);
    CHECK(violations(tree).empty());
    CHECK(table_of(tree) == table_of(living(history)));
    for (const float light : tree.light) REQUIRE(light >= 0.0f);
  }
}

TEST_CASE("growth: the same config and seed make the same tree with 1 and 2 threads") {
  for (const char* environment : {"light", "space"}) {
    const Parameters parameters =
        growth_parameters("p09-fig7-50", {"steps=20", std::string("growth.environment=") + environment,
                                          "growth.r=3", "growth.markers.density=2000"});
    std::string one;
    {
      const ThreadLimit limit(1);
      one = table_of(grow(parameters));
    }
    const ThreadLimit limit(2);
    CHECK(table_of(grow(parameters)) == one);
    CHECK(table_of(grow(parameters)) == one);
  }
}

TEST_CASE("growth: the seed changes the tree") {
  CHECK(table_of(grow(seeded("s4-fig6", 1))) != table_of(grow(seeded("s4-fig6", 2))));
}

TEST_CASE("growth: a run of N steps is the beginning of a run of M steps, whatever is chosen") {
  for (Parameters parameters : small_family()) {
    const Skeleton history = grow(parameters, true);
    for (const int steps : {1, 4, 7}) {
      if (steps >= parameters.steps) continue;
      Parameters shorter = parameters;
      shorter.steps = steps;
      Skeleton past = grow(shorter);
      past.light.clear();
      past.vigour.clear();
      REQUIRE(table_of(cut_at_step(history, static_cast<std::uint32_t>(steps))) == table_of(past));
      REQUIRE(table_of(cut_at_step(history, static_cast<std::uint32_t>(steps), true)) ==
              table_of(cut_at_step(grow(shorter, true), static_cast<std::uint32_t>(steps), true)));
    }
  }
}

TEST_CASE("growth: every choice changes the tree") {
  std::map<std::string, std::size_t> seen;
  const std::vector<Parameters> family = variants();
  for (std::size_t i = 0; i < family.size(); ++i) {
    const auto [same, is_new] = seen.emplace(table_of(grow(family[i])), i);
    INFO("variants " << same->second << " and " << i);
    CHECK(is_new);
  }
}

TEST_CASE("growth: the pipe rule holds at every node of the history, and living wood is at least as thick") {
  std::size_t shed = 0;
  for (const Parameters& parameters : small_family()) {
    const double n = parameters.pipe_exponent;
    const Skeleton history = grow(parameters, true);
    std::vector<double> sums(history.node_count(), 0.0);
    std::vector<double> living_sums(history.node_count(), 0.0);
    for (std::size_t i = history.root_count(); i < history.node_count(); ++i) {
      const double area = std::pow(history.diameter[i], n);
      sums[history.parent[i]] += area;
      if (!history.is_shed(i)) living_sums[history.parent[i]] += area;
      REQUIRE(history.diameter[i] <= history.diameter[history.parent[i]]);
      shed += history.is_shed(i);
    }
    for (std::size_t i = 0; i < history.node_count(); ++i) {
      const double area = std::pow(history.diameter[i], n);
      const double expected = sums[i] > 0 ? sums[i] : std::pow(parameters.tip_diameter, n);
      REQUIRE(std::abs(area - expected) <= 1e-9 * expected);
      REQUIRE(area >= living_sums[i] * (1 - 1e-9));
    }
  }
  CHECK(shed > 1000);
}

TEST_CASE("growth: the root has the light and vigour of all buds") {
  // In the first of them few buds die in the last step.
  for (const char* preset : {"s4-fig4", "space-oak", "p09-fig7-50"}) {
    INFO(preset);
    const Parameters parameters = growth_parameters(preset, {"steps=9"});
    Simulation simulation(parameters);
    while (simulation.step() < parameters.steps) REQUIRE(simulation.advance());
    simulation.sense();
    const GrowingTree& tree = simulation.trees()[0];
    double light = 0.0;
    double vigour = 0.0;
    for (std::size_t i = 0; i < tree.plant.buds.size(); ++i) {
      light += tree.light[i];
      vigour += tree.vigour[i];
    }
    const Skeleton skeleton = grow(parameters);
    CHECK(skeleton.light[0] == Approx(light));
    CHECK(skeleton.vigour[0] == Approx(vigour));
  }
}

TEST_CASE("growth: S4 Fig. 3, all weight on the default direction, lies in one plane") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Skeleton tree = grow(seeded("s4-fig3", seed));
    CHECK(tree.internode_count() > 20);
    for (const Vec3& position : tree.position) CHECK(std::abs(position.z) < 1e-12);
  }
}

TEST_CASE("growth: trees of S4 Fig. 6 stand upright, and lean if the first of tied voxels is taken") {
  for (const int steps : {5, 7, 10}) {
    for (const Tie tie : {Tie::mean, Tie::first}) {
      std::vector<double> x, z, lean;
      for (std::uint64_t seed = 1; seed <= 64; ++seed) {
        Parameters parameters = seeded("s4-fig6", seed, steps);
        parameters.tie = tie;
        const Vec3 center = relative_center_of_mass(grow(parameters));
        x.push_back(center.x);
        z.push_back(center.z);
        lean.push_back(glm::length(center));
      }
      INFO(steps << " steps, median lean " << median(lean));
      if (tie == Tie::first) {
        CHECK(median(lean) > 0.1);
        continue;
      }
      CHECK(median(lean) <= 0.05);
      for (const std::vector<double>& values : {x, z}) {
        const double count = double(values.size());
        const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
        double squares = 0.0;
        for (const double value : values) squares += (value - mean) * (value - mean);
        CHECK(std::abs(mean) <= 3.0 * std::sqrt(squares / (count - 1) / count));
      }
    }
  }
}

TEST_CASE("growth: trees of S4 have the sizes of an independent trial of the model") {
  // Means over 8 seeds of another program: 96, 355, 1680 and 8228 internodes at 5, 7, 10 and 15 steps.
  const std::vector<std::pair<int, double>> trials = {{5, 96}, {7, 355}, {10, 1680}, {15, 8228}};
  for (const auto& [steps, expected] : trials) {
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= 24; ++seed)
      sum += double(grow(seeded("s4-fig6", seed, steps)).internode_count());
    INFO(steps << " steps: " << sum / 24);
    CHECK(std::abs(sum / 24 / expected - 1.0) < 0.1);
  }
}

TEST_CASE("growth: lambda takes a Borchert-Honda tree from decurrent to excurrent") {
  double last_height = 0.0;
  for (const char* preset : {"p09-fig7-50", "p09-fig7-52", "p09-fig7-54"}) {
    const Skeleton tree = grow(seeded(preset, 1));
    Box box;
    for (const Vec3& position : tree.position) box.include(position);
    CHECK(box.high.y > 1.2 * last_height);
    last_height = box.high.y;
  }
}

TEST_CASE("growth: a step that would make too many internodes is not taken, and says so") {
  const Parameters parameters = growth_parameters("s4-fig8", {"growth.max_internodes=1000"});
  const RunResult result = Engine::run(parameters, {});
  CHECK_FALSE(result.is_complete);
  CHECK(result.skeleton.internode_count() <= 1000);
  CHECK(result.skeleton.internode_count() > 300);
  CHECK(violations(result.skeleton).empty());
  REQUIRE(result.report.warnings.size() == 1);
  const std::string expected_begin = "stopped after step ";
  CHECK(result.report.warnings[0].rfind(expected_begin, 0) == 0);
  CHECK(result.report.warnings[0].find("growth.max_internodes = 1000") != std::string::npos);
}

TEST_CASE("growth: a stopped run returns the tree so far") {
  std::stop_source source;
  RunContext context;
  context.stop = source.get_token();
  context.progress = [&](const Progress& now) {
    if (now.done == 3) source.request_stop();
  };
  const RunResult result = Engine::run(growth_parameters("s4-fig8"), context);
  CHECK_FALSE(result.is_complete);
  CHECK(table_of(result.skeleton) == table_of(grow(growth_parameters("s4-fig8", {"steps=3"}))));
}

TEST_CASE("growth: progress is told once a step, up to the last") {
  RunContext context;
  std::vector<double> done;
  context.progress = [&](const Progress& now) {
    CHECK(now.total == 5);
    done.push_back(now.done);
  };
  Engine::run(growth_parameters("s4-fig6"), context);
  CHECK(done == std::vector<double>{1, 2, 3, 4, 5});
}

TEST_CASE("growth: the shadow layer is made only if asked for") {
  CHECK(Engine::run(growth_parameters("s4-fig6"), {}).layers.empty());
  RunContext context;
  context.layers = {"shadow", "graph"};
  const RunResult result = Engine::run(growth_parameters("s4-fig6"), context);
  REQUIRE(result.layers.size() == 1);
  CHECK(result.layers[0].name == "shadow");
  CHECK(std::get<VoxelLayer>(result.layers[0].data).voxels.size() > 100);
}

TEST_CASE("growth: a seed without enough light stays a seed") {
  const RunResult result = Engine::run(growth_parameters("s4-fig6", {"growth.alpha=0.5"}), {});
  CHECK(result.skeleton.internode_count() == 0);
  CHECK(violations(result.skeleton).empty());
}
