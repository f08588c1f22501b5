#include "pathplan/subgraph_volume.h"

#include "common/base/rng.h"
#include "tests/catch.h"
#include "tests/pathplan/graphs.h"

using namespace ramify;
using namespace ramify::pathplan;
using namespace ramify::test;

namespace {

constexpr SubgraphShape kRound[] = {SubgraphShape::sphere_portion, SubgraphShape::cone,
                                    SubgraphShape::inverted_cone, SubgraphShape::ellipsoid};

Level row_of(SubgraphShape shape, double alpha_deg) {
  Level row;
  row.subgraph = shape;
  row.alpha_deg = alpha_deg;
  return row;
}

bool is_near(const Vec3& a, const Vec3& b) {
  return glm::distance(a, b) < 1e-9;
}

}  // namespace

TEST_CASE("subgraph volume: the reach is r at level 2 and a times as far at each later one") {
  Level row;
  row.r = 2.0;
  row.a = 0.5;
  CHECK(subgraph_radius(row, 2) == 2.0);
  CHECK(subgraph_radius(row, 3) == 1.0);
  CHECK(subgraph_radius(row, 5) == 0.25);
}

TEST_CASE("subgraph volume: each shape starts at the origin and goes along +Y as far as it reaches") {
  struct Case {
    SubgraphShape shape;
    double alpha_deg;
    Vec3 low;
    Vec3 high;
  };
  const double wide = 3.0 * std::tan(radians(30.0));
  const double ball = 3.0 * std::sin(radians(30.0));
  const std::vector<Case> cases = {
      {SubgraphShape::sphere_portion, 30.0, {-ball, 0.0, -ball}, {ball, 3.0, ball}},
      {SubgraphShape::sphere_portion, 90.0, {-3.0, 0.0, -3.0}, {3.0, 3.0, 3.0}},
      {SubgraphShape::sphere_portion, 180.0, {-3.0, -3.0, -3.0}, {3.0, 3.0, 3.0}},
      {SubgraphShape::cone, 30.0, {-wide, 0.0, -wide}, {wide, 3.0, wide}},
      {SubgraphShape::inverted_cone, 30.0, {-wide, 0.0, -wide}, {wide, 3.0, wide}},
      {SubgraphShape::ellipsoid, 30.0, {-wide / 2, 0.0, -wide / 2}, {wide / 2, 3.0, wide / 2}},
  };
  for (const Case& c : cases) {
    const Volume volume = subgraph_volume(row_of(c.shape, c.alpha_deg), 3.0);
    INFO("shape " << static_cast<int>(c.shape) << ", alpha " << c.alpha_deg);
    CHECK(is_near(bounds(volume).low, c.low));
    CHECK(is_near(bounds(volume).high, c.high));
    CHECK(contains(volume, Vec3(0.0)));
  }
  // A cone has its tip outwards, an inverted one at the origin.
  const Vec3 aside(0.9 * wide, 0.1, 0.0);
  const Vec3 far_aside(0.9 * wide, 2.9, 0.0);
  CHECK(contains(subgraph_volume(row_of(SubgraphShape::cone, 30.0), 3.0), aside));
  CHECK_FALSE(contains(subgraph_volume(row_of(SubgraphShape::cone, 30.0), 3.0), far_aside));
  CHECK(contains(subgraph_volume(row_of(SubgraphShape::inverted_cone, 30.0), 3.0), far_aside));
  CHECK_FALSE(contains(subgraph_volume(row_of(SubgraphShape::inverted_cone, 30.0), 3.0), aside));
}

TEST_CASE("subgraph volume: it holds the points that the shape's formula says") {
  for (const SubgraphShape shape : kRound) {
    for (const double alpha : {10.0, 45.0, 80.0, 120.0}) {
      if (alpha > 90.0 && shape != SubgraphShape::sphere_portion) continue;
      for (const double reach : {0.4, 3.0}) {
        const Level row = row_of(shape, alpha);
        const Volume volume = subgraph_volume(row, reach);
        const Solid solid(volume);
        const Box box = bounds(volume);
        Rng rng = Rng::stream(1, Stream::dart, 0);
        int inside = 0;
        for (int i = 0; i < 3000; ++i) {
          const Vec3 p =
              box.low - 0.1 + (box.size() + 0.2) * Vec3(rng.uniform(), rng.uniform(), rng.uniform());
          const double across = std::hypot(p.x, p.z);
          const bool is_inside = solid.contains(p);
          inside += is_inside ? 1 : 0;
          // Closer to the surface than this either answer will do.
          if (is_inside) REQUIRE(is_in_subgraph(row, reach, p.y, across, 1e-9));
          if (!is_inside) REQUIRE_FALSE(is_in_subgraph(row, reach, p.y, across, -1e-9));
        }
        CHECK(inside > 50);
      }
    }
  }
}

TEST_CASE("subgraph volume: a custom one is the row's own volume, scaled about the origin by the reach") {
  Level row = row_of(SubgraphShape::custom, 45.0);
  row.volume = {.shape = Shape::cylinder, .center = {0.1, 0.2, 0.0}, .radius = 0.25, .height = 0.5};
  for (const double reach : {0.3, 1.0, 4.0}) {
    const Box box = bounds(subgraph_volume(row, reach));
    CHECK(is_near(box.low, reach * Vec3(-0.15, 0.2, -0.25)));
    CHECK(is_near(box.high, reach * Vec3(0.35, 0.7, 0.25)));
    CHECK(contains(subgraph_volume(row, reach), reach * Vec3(0.3, 0.6, 0.0)));
    CHECK_FALSE(contains(subgraph_volume(row, reach), reach * Vec3(0.3, 0.6, 0.2)));
  }
  row.volume.scale = {2.0, 1.0, 1.0};
  CHECK(is_near(bounds(subgraph_volume(row, 4.0)).high, {2.8, 2.8, 1.0}));
}
