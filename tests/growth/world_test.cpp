// What trees share a world with: obstacles, markers, the sun, each other.

#include <fstream>

#include "common/skeleton/passes.h"
#include "growth/allocation.h"
#include "growth/engine.h"
#include "growth/simulation.h"
#include "tests/catch.h"
#include "tests/folder.h"
#include "tests/growth/runs.h"

using namespace ramify;
using namespace ramify::growth;
using namespace ramify::test;

namespace {

Skeleton grow(const Parameters& parameters) {
  return Engine::run(parameters, {}).skeleton;
}

/// The internodes of one of several trees.
std::size_t internodes_of(const Skeleton& skeleton, std::uint32_t tree) {
  std::vector<std::uint32_t> root(skeleton.node_count());
  std::size_t count = 0;
  for (std::uint32_t node = 0; node < skeleton.node_count(); ++node) {
    root[node] = skeleton.is_root(node) ? node : root[skeleton.parent[node]];
    count += !skeleton.is_root(node) && root[node] == tree;
  }
  return count;
}

TreePlace placed(const Parameters& parameters, const Vec3& position, std::uint64_t seed) {
  TreePlace place;
  static_cast<TreeParameters&>(place) = parameters;
  place.position = position;
  place.seed = seed;
  return place;
}

}  // namespace

TEST_CASE("world: trees out of each other's shade grow as if each were alone") {
  Parameters parameters = growth_parameters("p09-fig7-50", {"steps=12"});
  parameters.trees = {placed(parameters, {0, 0, 0}, 4), placed(parameters, {40.0, 0, 0}, 9)};
  const Skeleton both = grow(parameters);
  CHECK(violations(both).empty());
  CHECK(both.root_count() == 2);
  parameters.trees.clear();
  std::size_t next = 2;
  for (const auto& [seed, x] : {std::pair{4, 0.0}, std::pair{9, 40.0}}) {
    parameters.seed = static_cast<std::uint64_t>(seed);
    const Skeleton alone = grow(parameters);
    for (std::size_t node = 1; node < alone.node_count(); ++node, ++next) {
      REQUIRE(glm::length(both.position[next] - alone.position[node] - Vec3(x, 0, 0)) < 1e-6);
      REQUIRE(both.diameter[next] == alone.diameter[node]);
    }
  }
  CHECK(next == both.node_count());
}

TEST_CASE("world: trees that stand close compete, in light and in space") {
  for (const char* environment : {"light", "space"}) {
    Parameters parameters =
        growth_parameters("p09-fig7-50", {"steps=14", std::string("growth.environment=") + environment,
                                          "growth.r=4", "growth.markers.density=1500"});
    const std::size_t alone = grow(parameters).internode_count();
    parameters.trees = {placed(parameters, {0, 0, 0}, 1), placed(parameters, {0.3, 0, 0}, 2)};
    const Skeleton both = grow(parameters);
    INFO(environment << ": " << alone << " alone, " << internodes_of(both, 0) << " and "
                     << internodes_of(both, 1));
    CHECK(violations(both).empty());
    CHECK(double(internodes_of(both, 0)) < 0.9 * double(alone));
    CHECK(internodes_of(both, 1) > 50);
  }
}

TEST_CASE("world: each tree may have values of its own, and has the config's elsewhere") {
  const Parameters parameters = growth_parameters(
      "p09-fig7-50",
      {"growth.trees=[{position = [0.0, 0.0, 0.0]}, {position = [9.0, 0.0, 0.0], lambda = 0.54, "
       "tropism = {east = {weight = 0.4, direction = [1.0, 0.0, 0.0]}}}]",
       "growth.lambda=0.48", "seed=7"});
  const std::vector<TreePlace> trees = parameters.planted();
  REQUIRE(trees.size() == 2);
  CHECK(trees[0].lambda.at(1) == 0.48);
  CHECK(trees[1].lambda.at(1) == 0.54);
  CHECK(trees[1].allocation == Allocation::borchert_honda);
  CHECK(trees[0].tropism.size() == 1);
  CHECK(trees[1].tropism.size() == 2);
  CHECK(trees[1].tropism.at("up").weight.at(1) == 0.12);
  CHECK(trees[0].seed == 7);
  CHECK(trees[1].seed == 8);
}

TEST_CASE("world: no internode runs through an obstacle, however thin or round") {
  const Folder folder;
  std::ofstream(folder.file("tent.obj")) << "v -1 0.8 -1\nv 1 0.8 -1\nv 1 0.8 1\nv -1 0.8 1\nv 0 1.6 0\n"
                                            "f 1 2 3 4\nf 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n";
  const std::vector<std::string> volumes = {
      R"({shape = "mesh", file = ")" + folder.file("tent.obj") + R"("})",
      R"({shape = "box", center = [0.3, 1.0, 0.0], size = [0.02, 4.0, 4.0]})",
      R"({shape = "sphere", center = [0.0, 1.2, 0.1], radius = 0.4})",
      R"({shape = "cylinder", center = [0.0, 0.9, 0.0], radius = 3.0, height = 0.01})"};
  for (const std::string& volume : volumes) {
    INFO(volume);
    const Parameters parameters =
        growth_parameters("p09-fig7-50", {"growth.obstacles=[{volume = " + volume + "}]", "steps=15"});
    const Skeleton tree = grow(parameters);
    CHECK(tree.internode_count() > 100);
    const Solid solid(parameters.obstacles[0].volume);
    for (std::size_t node = 1; node < tree.node_count(); ++node) {
      for (int i = 0; i <= 20; ++i) {
        const Vec3 point = glm::mix(tree.position[tree.parent[node]], tree.position[node], i / 20.0);
        REQUIRE_FALSE(solid.contains(point));
      }
    }
  }
}

TEST_CASE("world: an obstacle that does not block may still shade") {
  const std::string roof =
      "growth.obstacles=[{blocks = false, shadow = 0.9, volume = {shape = \"box\", "
      "center = [0.0, 1.5, 0.0], size = [6.0, 1.0, 6.0]}}]";
  const Parameters open = growth_parameters("p09-fig7-50", {"steps=16"});
  const Parameters shaded = growth_parameters("p09-fig7-50", {"steps=16", roof});
  CHECK(double(grow(shaded).internode_count()) < 0.5 * double(grow(open).internode_count()));

  Simulation simulation(shaded);
  CHECK(simulation.shadow().at(simulation.shadow().voxel_of({0.0, 1.5, 0.0})) == std::lround(0.9 * 65536));
  CHECK(simulation.shadow().at(simulation.shadow().voxel_of({0.0, 0.5, 0.0})) == 0);
}

TEST_CASE("world: with the sun aside shadows fall away from it, and trees bend to it") {
  Parameters parameters = growth_parameters("p09-fig7-50", {"steps=16"});
  parameters.sun_direction = {1.0, 0.6, 0.0};
  double lean = 0.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    parameters.seed = seed;
    lean += relative_center_of_mass(grow(parameters)).x / 5;
  }
  CHECK(lean > 0.02);
}

TEST_CASE("world: markers near wood are gone, and a bud has Q = 1 only where one is in sight") {
  const Parameters parameters =
      growth_parameters("p09-fig7-50", {"growth.environment=space", "growth.r=4", "growth.rho=2", "steps=12",
                                        "growth.markers.density=3000", "growth.w_optimal=0.4"});
  Simulation simulation(parameters);
  std::size_t last = simulation.markers()->count();
  for (int i = 0; i < parameters.steps; ++i) {
    REQUIRE(simulation.advance());
    CHECK(simulation.markers()->count() <= last);
    last = simulation.markers()->count();
  }
  simulation.sense();
  const GrowingTree& tree = simulation.trees()[0];
  CHECK(tree.plant.internode_count() > 200);
  const PointLayer markers = simulation.markers()->layer();
  double nearest = 1.0;
  for (std::size_t node = 0; node < tree.plant.node_count(); ++node) {
    if (tree.plant.is_cut(node)) continue;
    for (const auto& marker : markers.points) {
      nearest = std::min(nearest, glm::length(Vec3(marker) - tree.plant.position[node]));
    }
  }
  CHECK(nearest >= 0.2 - 1e-6);
  std::size_t seeing = 0;
  for (std::size_t i = 0; i < tree.light.size(); ++i) {
    CHECK((tree.light[i] == 0.0 || tree.light[i] == 1.0));
    if (tree.light[i] == 0.0) continue;
    ++seeing;
    const Bud& bud = tree.plant.buds[i];
    const Vec3 apex = tree.plant.position[bud.node];
    bool is_seen = false;
    for (const auto& marker : markers.points) {
      const Vec3 towards = Vec3(marker) - apex;
      const double distance = glm::length(towards);
      is_seen = is_seen || (distance <= 0.4 + 1e-6 && glm::dot(towards, Vec3(tree.plant.bud_direction[i])) >=
                                                          std::cos(radians(45.0)) * distance - 1e-6);
    }
    CHECK(is_seen);
  }
  CHECK(seeing > 10);
}

TEST_CASE("world: a tree that grows in space stays near its markers") {
  const Parameters parameters = growth_parameters(
      "p09-fig7-50",
      {"growth.environment=space", "growth.r=5", "steps=30", "growth.w_optimal=0.2",
       "growth.shed_threshold=0", "growth.tropism.up.weight=0",
       R"(growth.markers={density = 5000, volume = {shape = "sphere", center = [0.0, 1.0, 0.0], radius = 1.2}})"});
  const Skeleton tree = grow(parameters);
  CHECK(tree.internode_count() > 300);
  for (const Vec3& position : tree.position) CHECK(glm::length(position - Vec3(0, 1, 0)) < 1.2 + 0.8);
}

TEST_CASE("world: without history a run keeps living nodes only") {
  const Parameters parameters = growth_parameters("p09-fig7-50", {"growth.shed_threshold=0.4", "steps=14"});
  Simulation simulation(parameters);
  while (simulation.step() < parameters.steps) REQUIRE(simulation.advance());
  const Plant& plant = simulation.trees()[0].plant;
  CHECK(double(plant.node_count()) <= 1.26 * double(plant.internode_count() + 1));
  CHECK_FALSE(simulation.trees()[0].history);
}
