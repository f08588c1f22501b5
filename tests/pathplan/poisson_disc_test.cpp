#include "pathplan/poisson_disc.h"

#include <set>
#include <stop_token>

#include "common/base/errors.h"
#include "common/base/parallel.h"
#include "pathplan/point_grid.h"
#include "tests/catch.h"
#include "tests/pathplan/volumes.h"

using namespace ramify;
using namespace ramify::pathplan;
using namespace ramify::test;

namespace {

double least_distance(const std::vector<Vec3>& points) {
  double least = 1e9;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, glm::distance(points[i], points[j]));
  }
  return least;
}

}  // namespace

TEST_CASE("nodes: exactly K, the root first, all inside and no two nearer than the spacing") {
  for (const Place& place : places()) {
    for (const int count : {2, 17, 300, 1500}) {
      for (const std::uint64_t seed : {1, 2, 3}) {
        INFO(place.name << ", " << count << " nodes, seed " << seed);
        const Nodes nodes = scatter_nodes(place.volume, place.root, {.nodes = count}, seed);
        REQUIRE(nodes.position.size() == static_cast<std::size_t>(count));
        CHECK(nodes.position.front() == place.root);
        CHECK(least_distance(nodes.position) >= nodes.spacing);
        for (const Vec3& node : nodes.position) REQUIRE(contains(place.volume, node));
      }
    }
  }
}

TEST_CASE("nodes: the spacing is 0.75 of the cube root of a node's share") {
  const Volume ball{.shape = Shape::sphere, .radius = 2.0};
  const Nodes nodes = scatter_nodes(ball, Vec3(0.0), {.nodes = 4000});
  CHECK(std::abs(nodes.spacing - 0.75 * std::cbrt(volume_of(ball) / 4000)) < 1e-12);
}

TEST_CASE("nodes: the number follows from a given spacing") {
  const Volume ball{.shape = Shape::sphere, .radius = 2.0};
  const Nodes asked = scatter_nodes(ball, Vec3(0.0), {.nodes = 4000});
  const Nodes given = scatter_nodes(ball, Vec3(0.0), {.nodes = 10, .spacing = asked.spacing});
  CHECK(given.spacing == asked.spacing);
  CHECK(given.position == asked.position);
  // Where the ball has room for the root alone.
  CHECK(scatter_nodes(ball, Vec3(0.0), {.spacing = 5.0}).position.size() == 1);
}

TEST_CASE("nodes: where parts overlap they are no denser") {
  const Volume ball{.shape = Shape::sphere, .radius = 2.0};
  const Volume twice{.shape = Shape::union_of, .parts = {ball, ball}};
  CHECK(scatter_nodes(twice, Vec3(0.0), {.nodes = 500}).position ==
        scatter_nodes(ball, Vec3(0.0), {.nodes = 500}).position);
}

TEST_CASE("nodes: all parts of the volume are filled alike") {
  const Volume ball{.shape = Shape::sphere, .radius = 2.0};
  const Nodes nodes = scatter_nodes(ball, Vec3(0.0), {.nodes = 8000}, 5);
  // Octants, and the inner ball of half the volume.
  int octants[8] = {};
  int inner = 0;
  for (const Vec3& p : nodes.position) {
    ++octants[(p.x < 0 ? 1 : 0) + (p.y < 0 ? 2 : 0) + (p.z < 0 ? 4 : 0)];
    if (glm::length(p) < 2.0 * std::cbrt(0.5)) ++inner;
  }
  for (const int octant : octants) CHECK(std::abs(octant - 1000) < 60);
  CHECK(std::abs(inner - 4000) < 250);  // the hull is a little denser: nothing crowds it from outside
}

TEST_CASE("nodes: the seed changes them, the number of threads does not") {
  const Place place = places()[1];
  const Nodes nodes = scatter_nodes(place.volume, place.root, {.nodes = 2000}, 1);
  CHECK(nodes.position != scatter_nodes(place.volume, place.root, {.nodes = 2000}, 2).position);
  const ThreadLimit limit(1);
  CHECK(nodes.position == scatter_nodes(place.volume, place.root, {.nodes = 2000}, 1).position);
}

TEST_CASE("nodes: near numbers are near places") {
  const Place place = places()[1];
  const Nodes nodes = scatter_nodes(place.volume, place.root, {.nodes = 20'000});
  double apart = 0.0;
  for (std::size_t i = 2; i < nodes.position.size(); ++i) {
    apart += glm::distance(nodes.position[i - 1], nodes.position[i]);
  }
  CHECK(apart / 20'000 < 3.0 * nodes.spacing);
}

TEST_CASE("nodes: a stop request ends the throwing") {
  std::stop_source stop;
  stop.request_stop();
  const Place place = places()[0];
  const OpenDomain open(place.volume);
  const std::vector<Vec3> roots = {place.root};
  const PoissonDisc disc(open.solid, {.nodes = 5000}, volume_of(place.volume), roots);
  CHECK(disc.scatter(open.domain, roots, true, 1, stop.get_token()).position.size() == 1);
}

TEST_CASE("nodes: a volume lost in its box is an error, not a lack of memory") {
  const Volume far_apart{.shape = Shape::union_of,
                         .parts = {{.shape = Shape::sphere, .radius = 4.0},
                                   {.shape = Shape::sphere, .center = {900, 900, 900}, .radius = 4.0}}};
  // On so coarse a count either ball may be missed; the spacing is given.
  try {
    scatter_nodes(far_apart, Vec3(0.0), {.spacing = 0.01});
    FAIL("no error");
  } catch (const RunError& error) {
    CHECK(std::string(error.what()).find("cells in the volume's box (at most 2.68e+08;") !=
          std::string::npos);
  }
}

TEST_CASE("point grid: every point is in one cell, and a box of cells holds the points in the box") {
  const Place place = places()[2];
  const Nodes nodes = scatter_nodes(place.volume, place.root, {.nodes = 500});
  for (const double edge : {0.01, 0.3, 1.0, 50.0}) {
    const PointGrid grid(nodes.position, edge);
    std::multiset<std::uint32_t> met;
    for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
      for (const std::uint32_t id : grid.ids_in(cell)) met.insert(id);
    }
    CHECK(met.size() == 500);
    CHECK(std::set<std::uint32_t>(met.begin(), met.end()).size() == 500);
    CHECK(grid.cell_count() <= 8 * 501);

    const Box box{place.root - 0.4, place.root + 0.6};
    std::set<std::uint32_t> in_cells;
    grid.for_each_run(grid.touching(box),
                      [&](std::span<const std::uint32_t> run) { in_cells.insert(run.begin(), run.end()); });
    for (std::uint32_t i = 0; i < 500; ++i) {
      const Vec3& p = nodes.position[i];
      const bool is_within =
          glm::all(glm::lessThanEqual(box.low, p)) && glm::all(glm::lessThanEqual(p, box.high));
      if (is_within) REQUIRE(in_cells.count(i) == 1);
    }
  }
}
