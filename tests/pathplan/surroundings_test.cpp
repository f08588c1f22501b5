#include "pathplan/surroundings.h"

#include "tests/catch.h"
#include "tests/pathplan/graphs.h"

using namespace ramify;
using namespace ramify::pathplan;
using namespace ramify::test;

namespace {

const BallAndWall kBallAndWall{
    .center = {1.0, 0.5, 0.0}, .radius = 0.6, .wall = {Vec3(-0.501, -1.0, -1.0), Vec3(-0.5, 1.0, 1.0)}};

Surroundings obstructed() {
  Parameters parameters;
  parameters.obstacles = kBallAndWall.obstacles();
  return Surroundings(parameters);
}

}  // namespace

TEST_CASE("surroundings: an empty world takes nothing and costs nothing") {
  const Surroundings open;
  CHECK_FALSE(open.has_obstacles());
  CHECK_FALSE(open.has_costs());
  CHECK(open.is_free(Vec3(0.0)));
  CHECK(open.is_free(Vec3(0.0), Vec3(9.0)));
  CHECK(open.volume_taken_of({}) == 0.0);
  CHECK(open.cost_factor(Vec3(0.0)) == 1.0);
}

TEST_CASE("surroundings: a point is free outside all obstacles, a segment if it meets none") {
  const Surroundings world = obstructed();
  CHECK(world.has_obstacles());
  CHECK(world.is_free(Vec3(0.0)));
  CHECK_FALSE(world.is_free(Vec3(1.2, 0.5, 0.0)));
  CHECK_FALSE(world.is_free(Vec3(-0.5005, 0.0, 0.0)));
  CHECK_FALSE(world.is_free({-0.9, 0.0, 0.0}, {0.0, 0.0, 0.0}));  // through a wall of 1 mm
  CHECK(world.is_free({-0.9, 2.0, 0.0}, {0.0, 2.0, 0.0}));        // above it

  Rng rng = Rng::stream(1, Stream::dart, 0);
  const auto point = [&] {
    return Vec3(rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0));
  };
  int met = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 from = point();
    const Vec3 to = point();
    met += kBallAndWall.meets(from, to) ? 1 : 0;
    REQUIRE(world.is_free(from, to) != kBallAndWall.meets(from, to));
    REQUIRE(world.is_free(from) != kBallAndWall.meets(from, from));
  }
  CHECK(met > 500);
}

TEST_CASE("surroundings: what obstacles take of a volume, those that overlap counted once") {
  const Volume ball{.shape = Shape::sphere, .radius = 1.0};
  const Volume right{.shape = Shape::box, .center = {1.0, 0.0, 0.0}, .size = {2.0, 4.0, 4.0}};
  const Volume upper{.shape = Shape::box, .center = {0.0, 1.0, 0.0}, .size = {4.0, 2.0, 4.0}};
  const Volume elsewhere{.shape = Shape::sphere, .center = {9.0, 0.0, 0.0}};
  const double all = volume_of(ball);
  Parameters parameters;
  parameters.obstacles = {{right}, {elsewhere}};
  CHECK(std::abs(Surroundings(parameters).volume_taken_of(ball) / all - 0.5) < 0.01);
  parameters.obstacles = {{right}, {right}, {upper}};
  CHECK(std::abs(Surroundings(parameters).volume_taken_of(ball) / all - 0.75) < 0.01);
}

TEST_CASE("surroundings: cost factors are multiplied where their volumes overlap") {
  Parameters parameters;
  parameters.costs = {{{.shape = Shape::sphere, .radius = 1.0}, 2.0},
                      {{.shape = Shape::sphere, .center = {1.0, 0.0, 0.0}, .radius = 1.0}, 0.25}};
  const Surroundings world(parameters);
  CHECK(world.has_costs());
  CHECK_FALSE(world.has_obstacles());
  CHECK(world.cost_factor({-0.5, 0.0, 0.0}) == 2.0);
  CHECK(world.cost_factor({0.5, 0.0, 0.0}) == 0.5);
  CHECK(world.cost_factor({1.5, 0.0, 0.0}) == 0.25);
  CHECK(world.cost_factor({5.0, 0.0, 0.0}) == 1.0);
}

TEST_CASE("surroundings: an edge costs what its middle says, in the world and not in the graph's frame") {
  Parameters parameters;
  parameters.costs = {{{.shape = Shape::sphere, .center = {10.0, 0.0, 0.0}, .radius = 0.3}, 8.0}};
  const Surroundings world(parameters);
  const Solid solid(Volume{.shape = Shape::sphere, .radius = 5.0});
  // +Y of the graph is +X of the world.
  const Domain domain{solid, world, frame_along({9.0, 0.0, 0.0}, {1.0, 0.0, 0.0})};
  Graph graph = graph_of({{0, 0, 0}, {0, 2, 0}, {0, 1, 0}}, {{0, 1}, {0, 2}, {1, 2}}, {1.0f, 1.0f, 1.5f});
  apply_cost_factors(graph, domain);
  CHECK(graph.weights == std::vector<float>{8.0f, 1.0f, 1.5f});
}

TEST_CASE("domain: the solid turns with the graph's frame, the obstacles stand in the world") {
  Parameters parameters;
  parameters.obstacles = {{{.shape = Shape::sphere, .center = {0.0, 4.0, 2.0}, .radius = 0.5}}};
  const Surroundings world(parameters);
  const Solid solid(Volume{.shape = Shape::cone, .radius = 0.5, .height = 3.0});
  for (const Vec3& along : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, -1, 0), glm::normalize(Vec3(1, 2, 3))}) {
    const Domain domain{solid, world, frame_along({0.0, 4.0, 0.0}, along)};
    CHECK(glm::distance(domain.frame.to_world({0, 1, 0}), Vec3(0, 4, 0) + along) < 1e-12);
    // Axes are perpendicular and right-handed: shapes keep their size and are not mirrored.
    CHECK(std::abs(glm::determinant(domain.frame.axes) - 1.0) < 1e-12);
    CHECK(std::abs(glm::distance(domain.frame.to_world({1, 2, 3}), domain.frame.to_world({-1, 0, 2})) - 3.0) <
          1e-12);
    CHECK(domain.contains({0.0, 0.5, 0.0}));
    CHECK_FALSE(domain.contains({0.0, -0.5, 0.0}));
    const bool is_blocked = along == Vec3(0, 0, 1);
    CHECK(domain.contains({0.0, 2.0, 0.0}) != is_blocked);
    CHECK(domain.is_free({0.0, 0.5, 0.0}, {0.0, 2.9, 0.0}) != is_blocked);
  }
}
