#include "common/mesh/axes.h"

#include "tests/catch.h"
#include "tests/common/trees.h"

using namespace ramify;
using namespace ramify::test;

TEST_CASE("axes: a pole is one row of points from its root to its tip") {
  const Skeleton s = pole(4);
  const Axes axes = find_axes(s);
  REQUIRE(axes.list.size() == 1);
  CHECK(axes.list[0].is_trunk());
  CHECK(axes.list[0].base == 0);
  REQUIRE(axes.points.size() == 5);
  for (std::size_t i = 0; i < axes.points.size(); ++i) {
    CHECK(axes.points[i].node == i);
    CHECK(axes.points[i].position == Vec3f(s.position[i]));
    CHECK(axes.points[i].radius == Approx(0.5 * s.diameter[i]));
  }
  CHECK(axes.thickest == Approx(0.5 * s.diameter[0]));
}

TEST_CASE(
    "axes: each internode stands in one row, after its parent, and laterals begin at their bearers' points") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Skeleton s = random_tree(seed, 300);
    const Axes axes = find_axes(s);
    std::vector<int> found(s.node_count(), 0);
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < axes.list.size(); ++i) {
      const Axis& axis = axes.list[i];
      CHECK(axis.first == next);
      next = axis.end();
      REQUIRE(axis.count >= 2);
      for (std::uint32_t point = axis.first + 1; point < axis.end(); ++point) {
        const std::uint32_t node = axes.points[point].node;
        ++found[node];
        CHECK(s.parent[node] == axes.points[point - 1].node);
      }
      const AxisPoint& base = axes.points[axis.first];
      CHECK(axes.points[axis.base].node == base.node);
      CHECK(axis.bearer_radius == axes.points[axis.base].radius);
      if (axis.is_trunk()) {
        CHECK(s.is_root(base.node));
        continue;
      }
      const Axis& bearer = axes.list[axis.bearer];
      CHECK((axis.bearer < i || axis.base == bearer.first));
      CHECK(axis.base >= bearer.first);
      CHECK(axis.base < bearer.end());
      CHECK(base.radius == axes.points[axis.first + 1].radius);
    }
    CHECK(next == axes.points.size());
    std::vector<std::uint32_t> at_roots;
    for (std::uint32_t i = 0; i < axes.list.size(); ++i) {
      if (s.is_root(axes.points[axes.list[i].first].node)) at_roots.push_back(i);
    }
    CHECK(axes.at_roots == at_roots);
    for (std::size_t node = 0; node < s.node_count(); ++node) CHECK(found[node] == (s.is_root(node) ? 0 : 1));
  }
}

TEST_CASE(
    "axes: an axis beside the trunk grows from the trunk's first point, and without a trunk all are trunks") {
  Skeleton s = pole(2);
  s.position.push_back(Vec3(1, 0, 0));
  s.parent.push_back(0);
  s.diameter.push_back(0.02);
  s.kind.push_back(Kind::stem);
  s.axis = {0, 0, 0, 1};
  Axes axes = find_axes(s);
  REQUIRE(axes.list.size() == 2);
  CHECK(axes.list[1].bearer == 0);
  CHECK(axes.list[1].base == axes.list[0].first);
  s.axis = {9, 0, 0, 1};
  axes = find_axes(s);
  CHECK(axes.list[0].is_trunk());
  CHECK(axes.list[1].is_trunk());
}

TEST_CASE("axes: no point is thinner than the thinnest radius, at bases neither") {
  Skeleton s = random_tree(3, 200);
  std::ranges::fill(s.diameter, 1e-9);
  s.diameter.back() = 0.5;
  const Axes axes = find_axes(s);
  CHECK(axes.thinnest > 1e-9f);
  CHECK(axes.thickest == 0.25f);
  for (const Axis& axis : axes.list) {
    CHECK(axis.bearer_radius == axes.thinnest);
    CHECK(axes.points[axis.first].radius >= axes.thinnest);
    for (std::uint32_t i = axis.first + 1; i < axis.end(); ++i)
      CHECK(axes.points[i].radius == (axes.points[i].node + 1 == s.node_count() ? 0.25f : axes.thinnest));
  }
}
