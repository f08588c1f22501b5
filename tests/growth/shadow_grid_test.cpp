#include "growth/shadow_grid.h"

#include <array>
#include <map>

#include "common/base/parallel.h"
#include "common/base/rng.h"
#include "growth/simulation.h"
#include "tests/catch.h"
#include "tests/growth/runs.h"

using namespace ramify;
using namespace ramify::growth;
using namespace ramify::test;

namespace {

using Voxels = std::map<std::array<int, 3>, std::int64_t>;

/// The same field by the definition, one voxel at a time.
Voxels brute_force(const std::vector<Coord>& casters, const Penumbra& penumbra) {
  Voxels field;
  for (const Coord& c : casters) {
    for (int q = 0; q <= penumbra.q_max; ++q) {
      const std::int64_t amount = std::lround(penumbra.a * std::pow(penumbra.b, -q) * 65536.0);
      for (int i = -q; i <= q; ++i) {
        for (int k = -q; k <= q; ++k) field[{c.x + i, c.y - q, c.z + k}] += amount;
      }
    }
  }
  return field;
}

void check_equal(const ShadowGrid& grid, const Voxels& expected) {
  std::size_t faults = 0;
  std::size_t shaded = 0;
  for (const auto& [voxel, value] : expected) {
    faults += grid.at({voxel[0], voxel[1], voxel[2]}) != value;
    shaded += value != 0;
  }
  CHECK(faults == 0);
  CHECK(grid.layer().voxels.size() == shaded);
}

std::vector<Coord> random_casters(std::uint64_t seed, std::size_t count, int spread) {
  Rng random = Rng::stream(seed, Stream::dart, 0);
  std::vector<Coord> casters;
  const auto place = [&] {
    return static_cast<int>(random.below(static_cast<std::uint64_t>(2 * spread))) - spread;
  };
  for (std::size_t i = 0; i < count; ++i) casters.emplace_back(place(), place(), place());
  return casters;
}

}  // namespace

TEST_CASE("shadow: one caster darkens a pyramid below it by a * b^-q") {
  ShadowGrid grid({.a = 0.2, .b = 2.0, .q_max = 4}, 1.0);
  grid.cast(std::vector<Coord>{{0, 0, 0}});
  CHECK(grid.at({0, 0, 0}) == std::lround(0.2 * 65536));
  CHECK(grid.at({1, -1, -1}) == std::lround(0.1 * 65536));
  CHECK(grid.at({4, -4, 0}) == std::lround(0.0125 * 65536));
  CHECK(grid.at({0, 1, 0}) == 0);
  CHECK(grid.at({2, -1, 0}) == 0);
  CHECK(grid.at({0, -5, 0}) == 0);
  CHECK(grid.layer().voxels.size() == 1 + 9 + 25 + 49 + 81);
}

TEST_CASE("shadow: the grid is the sum over all casters, exactly, whatever their number and penumbra") {
  const std::array penumbras = {Penumbra{}, Penumbra{.a = 0.37, .b = 1.3, .q_max = 9}, Penumbra{.q_max = 0}};
  for (const Penumbra& penumbra : penumbras) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const std::vector<Coord> casters = random_casters(seed, 300, 20);
      ShadowGrid grid(penumbra, 0.1);
      // In two parts, so that the table has to grow.
      grid.cast(std::span(casters).first(50));
      grid.cast(std::span(casters).subspan(50));
      check_equal(grid, brute_force(casters, penumbra));
    }
  }
}

TEST_CASE("shadow: taking every caster away leaves every voxel at 0") {
  const std::vector<Coord> casters = random_casters(1, 500, 15);
  ShadowGrid grid({}, 1.0);
  grid.cast(casters);
  grid.uncast(casters);
  CHECK(grid.layer().voxels.empty());
}

TEST_CASE("shadow: the world has no edge") {
  const std::vector<Coord> casters = {{0, 0, 0}, {40'000'000, 0, 0}, {-7, -90'000'000, 90'000'000}};
  ShadowGrid grid({}, 1.0);
  for (const Coord& caster : casters) grid.cast(std::vector<Coord>{caster});
  check_equal(grid, brute_force(casters, {}));
  grid.uncast(casters);
  CHECK(grid.layer().voxels.empty());
}

TEST_CASE("shadow: a voxel read by its site, or by a reader, is the voxel") {
  const std::vector<Coord> casters = random_casters(3, 200, 10);
  ShadowGrid grid({}, 1.0);
  grid.cast(casters);
  LeafReader reader = grid.reader();
  for (const Coord& voxel : random_casters(4, 200, 14)) {
    CHECK(reader.at(voxel) == grid.at(voxel));
    const Shadow before = grid.at(voxel);
    CHECK(grid.at(grid.site_of(voxel)) == before);
  }
  const Site site = grid.site_of({900, 0, 0});
  CHECK(grid.at(site) == 0);
  grid.cast(std::vector<Coord>{{900, 0, 0}});
  CHECK(grid.at(site) == grid.own_shadow());
}

TEST_CASE("shadow: a low sun shifts each level away from it by whole voxels") {
  for (const Vec3 sun : {Vec3(1, 1, 0), Vec3(-2, 1, 0.3), Vec3(0.2, 1, -1.4)}) {
    ShadowGrid grid({.sun_direction = glm::normalize(sun)}, 1.0);
    const std::vector<Coord> casters = random_casters(8, 700, 30);
    grid.cast(casters);
    Voxels expected;
    for (const Coord& c : casters) {
      for (int q = 0; q <= 4; ++q) {
        const int shift_x = static_cast<int>(std::lround(-q * sun.x / sun.y));
        const int shift_z = static_cast<int>(std::lround(-q * sun.z / sun.y));
        for (int i = -q; i <= q; ++i) {
          for (int k = -q; k <= q; ++k) {
            expected[{c.x + shift_x + i, c.y - q, c.z + shift_z + k}] +=
                std::lround(0.2 * std::pow(2.0, -q) * 65536.0);
          }
        }
      }
    }
    check_equal(grid, expected);
  }
}

TEST_CASE("shadow: a multiplicative caster adds the logarithms of its factors on levels 1 to 5") {
  ShadowGrid grid({.model = ShadowModel::multiplicative}, 1.0);
  grid.cast(std::vector<Coord>{{3, 9, -2}});
  Voxels expected;
  for (int q = 1; q <= 5; ++q) {
    for (int i = -q; i <= q; ++i) {
      for (int k = -q; k <= q; ++k) {
        const double distance = std::sqrt(i * i + q * q + k * k);
        expected[{3 + i, 9 - q, -2 + k}] =
            std::lround(-std::log(1.0 - 0.441 * std::pow(6.31, -distance)) * 65536.0);
      }
    }
  }
  CHECK(grid.own_shadow() == 0);
  CHECK(grid.at({3, 9, -2}) == 0);
  for (const auto& [voxel, value] : expected) CHECK(grid.at({voxel[0], voxel[1], voxel[2]}) == value);
}

TEST_CASE("shadow: a darkened voxel darkens no other") {
  ShadowGrid grid({}, 1.0);
  grid.darken(std::vector<Coord>{{5, 5, 5}, {-70, 0, 0}}, 1000);
  CHECK(grid.at({5, 5, 5}) == 1000);
  CHECK(grid.at({-70, 0, 0}) == 1000);
  CHECK(grid.layer().voxels.size() == 2);
}

TEST_CASE("shadow: many casters on two threads give the field of one") {
  const std::vector<Coord> casters = random_casters(6, 20'000, 40);
  ShadowGrid one({}, 1.0), two({}, 1.0);
  {
    const ThreadLimit limit(1);
    one.cast(casters);
  }
  const ThreadLimit limit(2);
  two.cast(casters);
  const VoxelLayer a = one.layer(), b = two.layer();
  CHECK(a.voxels == b.voxels);
  CHECK(a.values == b.values);
}

TEST_CASE("shadow: the root stands in the middle of a voxel") {
  const ShadowGrid grid({}, 0.5);
  CHECK(grid.voxel_of({0, 0, 0}) == Coord(0, 0, 0));
  CHECK(grid.voxel_of({0.24, -0.24, 0.26}) == Coord(0, 0, 1));
  CHECK(grid.voxel_of({-0.26, 1.0, -100}) == Coord(-1, 2, -200));
}

namespace {

/// Casters of a world as it stands after `step`, with no thought of when they began or ceased to be.
std::vector<Coord> living_casters(const Simulation& simulation, const Parameters& parameters) {
  std::vector<Coord> casters;
  for (const GrowingTree& tree : simulation.trees()) {
    const Plant& plant = tree.plant;
    if (parameters.casters == Casters::buds) {
      for (const Bud& bud : plant.buds) {
        if (!bud.is_dead()) casters.push_back(simulation.shadow().voxel_of(plant.position[bud.node]));
      }
      continue;
    }
    for (std::size_t node = 1; node < plant.node_count(); ++node) {
      const int age = simulation.step() - plant.birth_step[node];
      const bool has_leaves = parameters.leaf_lifespan == 0 || age < parameters.leaf_lifespan;
      if (!plant.is_cut(node) && has_leaves)
        casters.push_back(simulation.shadow().voxel_of(plant.position[node]));
    }
  }
  return casters;
}

void check_every_step(Parameters parameters, int steps) {
  parameters.steps = std::min(parameters.steps, steps);
  Simulation simulation(parameters);
  while (simulation.step() < parameters.steps) {
    REQUIRE(simulation.advance());
    check_equal(simulation.shadow(),
                brute_force(living_casters(simulation, parameters),
                            {.a = parameters.a, .b = parameters.b, .q_max = parameters.q_max}));
  }
}

}  // namespace

TEST_CASE("shadow: at every step of every preset the grid is the sum over the living casters") {
  for (const std::string& preset : growth_presets()) {
    INFO(preset);
    Parameters parameters = growth_parameters(preset);
    if (parameters.environment != Environment::light || parameters.shadow != ShadowModel::additive) continue;
    parameters.obstacles.clear();
    parameters.sun_direction = kUp;
    check_every_step(parameters, 9);
  }
}

TEST_CASE("shadow: the grid is the sum over the living casters whatever sheds, falls, aborts or is pruned") {
  const std::vector<std::vector<std::string>> variants = {
      {"growth.leaf_lifespan=2"},
      {"growth.leaf_lifespan=3", "growth.shed_threshold=0.3"},
      {"growth.casters=buds", "growth.bud_lifespan=2", "growth.shed_threshold=0.2"},
      {"growth.shed_by=vigour", "growth.shed_threshold=0.4", "growth.casters=buds"},
      {"growth.shed_by=vigour", "growth.shed_threshold=0.4", "growth.leaf_lifespan=4"},
      {"growth.tip_bud=terminal", "growth.casters=buds", "growth.sympodial=true"},
      {"growth.phyllotaxis=opposite", "growth.casters=buds", "growth.tip_bud=terminal"}};
  for (std::vector<std::string> variant : variants) {
    INFO(variant.front());
    variant.push_back(
        "growth.prune=[{step = 4, every = 3, cut = \"outside\", volume = {shape = \"sphere\", "
        "center = [0.0, 0.6, 0.0], radius = 0.6}}]");
    check_every_step(growth_parameters("p09-fig7-50", variant), 10);
  }
}
