#include "growth/shadow_grid.h"

#include <array>
#include <map>

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

TEST_CASE("shadow: a block that is gathered holds the same values as its voxels") {
  const std::vector<Coord> casters = random_casters(3, 200, 10);
  ShadowGrid grid({}, 1.0);
  grid.cast(casters);
  std::vector<Shadow> block(7 * 7 * 7);
  for (const Coord low : {Coord(-3, -3, -3), Coord(5, -20, 8), Coord(900, 0, 0)}) {
    grid.gather(low, 7, block);
    std::size_t at = 0;
    for (int x = 0; x < 7; ++x) {
      for (int y = 0; y < 7; ++y) {
        for (int z = 0; z < 7; ++z) CHECK(block[at++] == grid.at(low + Coord(x, y, z)));
      }
    }
  }
}

TEST_CASE("shadow: the root stands in the middle of a voxel") {
  const ShadowGrid grid({}, 0.5);
  CHECK(grid.voxel_of({0, 0, 0}) == Coord(0, 0, 0));
  CHECK(grid.voxel_of({0.24, -0.24, 0.26}) == Coord(0, 0, 1));
  CHECK(grid.voxel_of({-0.26, 1.0, -100}) == Coord(-1, 2, -200));
}

TEST_CASE("shadow: at every step of every preset the grid is the sum over the living casters") {
  for (const std::string& preset : growth_presets()) {
    INFO(preset);
    Parameters parameters = growth_parameters(preset);
    parameters.steps = std::min(parameters.steps, 9);
    Simulation simulation(parameters);
    while (simulation.step() < parameters.steps) {
      REQUIRE(simulation.advance());
      const Plant& plant = simulation.plant();
      std::vector<Coord> casters;
      if (parameters.casters == Casters::buds) {
        for (const Bud& bud : plant.buds)
          casters.push_back(simulation.shadow().voxel_of(plant.position[bud.node]));
      } else {
        for (std::size_t node = 1; node < plant.node_count(); ++node) {
          if (plant.shed_step[node] == kAlive)
            casters.push_back(simulation.shadow().voxel_of(plant.position[node]));
        }
      }
      check_equal(simulation.shadow(),
                  brute_force(casters, {.a = parameters.a, .b = parameters.b, .q_max = parameters.q_max}));
    }
  }
}
