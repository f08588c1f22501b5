#include "pathplan/lattice.h"

#include "tests/catch.h"
#include "tests/pathplan/graphs.h"

using namespace ramify;
using namespace ramify::pathplan;
using namespace ramify::test;

namespace {

/// The definition: every point of a lattice larger than the volume, looked at.
std::size_t points_by_hand(const Domain& domain, const Vec3& root, double edge) {
  std::size_t count = 0;
  for (int x = -40; x <= 40; ++x) {
    for (int y = -40; y <= 40; ++y) {
      for (int z = -40; z <= 40; ++z) count += domain.contains(root + edge * Vec3(x, y, z)) ? 1 : 0;
    }
  }
  return count;
}

}  // namespace

TEST_CASE("lattice: a box of 4 m at 1 m holds 5 x 5 x 5 nodes, the root first") {
  const OpenDomain open({.shape = Shape::box, .size = {4.0, 4.0, 4.0}});
  const Nodes nodes = lattice_nodes(open.domain, {1.0, -2.0, 0.0}, {.spacing = 1.0}, 64.0);
  CHECK(nodes.position.size() == 125);
  CHECK(nodes.position.front() == Vec3(1.0, -2.0, 0.0));
  CHECK(nodes.spacing == 1.0);
}

TEST_CASE("lattice: its nodes are all points of the lattice through the root that are in the domain") {
  const BallAndWall things{
      .center = {0.2, 1.6, 0.2}, .radius = 0.5, .wall = {Vec3(0.3, -9.0, -9.0), Vec3(0.4, 9.0, 9.0)}};
  Parameters parameters;
  parameters.obstacles = things.obstacles();
  const Surroundings obstructed(parameters);
  for (const Place& place : places()) {
    const OpenDomain open(place.volume);
    const Domain closed{open.solid, obstructed};
    for (const Vec3& root : {place.root, place.root + Vec3(0.013, 0.021, -0.017)}) {
      for (const Domain& domain : {open.domain, closed}) {
        if (!domain.contains(root)) continue;
        INFO(place.name);
        const Nodes nodes = lattice_nodes(domain, root, {.spacing = 0.19}, 1.0);
        CHECK(nodes.position.size() == points_by_hand(domain, root, 0.19));
        CHECK(nodes.position.front() == root);
        std::set<std::array<int, 3>> cells;
        for (const Vec3& node : nodes.position) {
          REQUIRE(domain.contains(node));
          const Vec3 steps = (node - root) / 0.19;
          REQUIRE(glm::distance(steps, glm::round(steps)) < 1e-9);
          const Coord cell(glm::round(steps));
          cells.insert({cell.x, cell.y, cell.z});
        }
        CHECK(cells.size() == nodes.position.size());
      }
    }
  }
}

TEST_CASE("lattice: without a spacing its edge is the cube root of a node's share, so K is about met") {
  const Volume ball{.shape = Shape::sphere, .radius = 2.0};
  const OpenDomain open(ball);
  const double cubic_metres = volume_of(ball);
  for (const int count : {500, 4000, 20'000}) {
    const Nodes nodes = lattice_nodes(open.domain, Vec3(0.0), {.nodes = count}, cubic_metres);
    CHECK(std::abs(nodes.spacing - std::cbrt(cubic_metres / count)) < 1e-12);
    CHECK(std::abs(static_cast<double>(nodes.position.size()) / count - 1.0) < 0.05);
  }
}
