#include "common/mesh/axes.h"

#include <algorithm>

#include "common/mesh/bark.h"
#include "common/mesh/mesher.h"
#include "tests/catch.h"
#include "tests/common/trees.h"

using namespace ramify;
using namespace ramify::test;

namespace {

/// The tree with every so many axes ended where they go on: what follows is an axis of its own.
Skeleton with_ended_axes(Skeleton tree, std::uint32_t every) {
  const std::vector<std::uint32_t> whole(tree.axis.begin(), tree.axis.end());
  std::uint32_t added = *std::max_element(whole.begin(), whole.end());
  for (std::uint32_t node = 0; node < tree.node_count(); ++node) {
    if (tree.is_root(node) || tree.is_root(tree.parent[node])) continue;
    const std::uint32_t parent = tree.parent[node];
    if (whole[node] == whole[parent]) tree.axis[node] = node % every == 0 ? ++added : tree.axis[parent];
  }
  return tree;
}

}  // namespace

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
  std::size_t continuations = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Skeleton s = seed < 10 ? random_tree(seed, 300) : with_ended_axes(random_tree(seed, 300), 3);
    const Axes axes = find_axes(s);
    std::vector<int> found(s.node_count(), 0);
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < axes.list.size(); ++i) {
      const Axis& axis = axes.list[i];
      CHECK(axis.first == next);
      next = axis.end();
      if (axis.count == 0) {
        CHECK(axes.list[axis.bearer].count > 2);
        ++continuations;
        continue;
      }
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
      const Axis& axis = axes.list[i];
      if (axis.count > 0 && s.is_root(axes.points[axis.first].node)) at_roots.push_back(i);
    }
    CHECK(axes.at_roots == at_roots);
    for (std::size_t node = 0; node < s.node_count(); ++node) CHECK(found[node] == (s.is_root(node) ? 0 : 1));
  }
  CHECK(continuations > 100);
}

TEST_CASE("axes: what leaves the end of an axis, about as thick, goes on as a part of it") {
  Skeleton s = pole(6);
  s.axis = {0, 0, 0, 1, 1, 2, 2};  // 2 goes on from 1, which goes on from 0
  add_node(s, {1, 2, 0}, 2, 0.5 * s.diameter[2]);
  s.axis[7] = 3;  // too thin
  add_node(s, {1, 4, 0}, 4, s.diameter[5]);
  s.axis[8] = 4;
  add_node(s, {-1, 4, 0}, 4, 0.9 * s.diameter[5]);
  s.axis[9] = 5;  // axis 2 has begun there before
  const Axes axes = find_axes(s);
  REQUIRE(axes.list.size() == 6);
  const auto counts = {7u, 0u, 0u, 2u, 2u, 2u};
  CHECK(std::ranges::equal(axes.list, counts, {}, &Axis::count));
  for (std::uint32_t node = 0; node <= 6; ++node) CHECK(axes.points[node].node == node);
  for (const std::uint32_t lateral : {3u, 4u, 5u}) CHECK(axes.list[lateral].bearer == 0);
  CHECK(axes.list[3].base == 2);
  CHECK(axes.list[4].base == 4);
  CHECK(axes.list[5].base == 4);
}

TEST_CASE("axes: a mesh of ended axes that go on is that of whole ones") {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Skeleton whole = random_tree(seed, 120);
    for (std::uint32_t node = 1; node < whole.node_count(); ++node) {
      const std::uint32_t parent = whole.parent[node];
      whole.diameter[node] = whole.diameter[parent] * (whole.axis[node] == whole.axis[parent] ? 0.95 : 0.6);
    }
    const Skeleton ended = with_ended_axes(whole, 2);
    REQUIRE(ended.axis != whole.axis);
    for (const MesherOptions& options :
         {MesherOptions{}, MesherOptions{.centre_line = CentreLine::catmull_rom},
          MesherOptions{.method = MeshMethod::cones}}) {
      const Mesh a = build_mesh(whole, options);
      const Mesh b = build_mesh(ended, options);
      CHECK(a.positions == b.positions);
      CHECK(a.uvs == b.uvs);
      CHECK(a.triangles == b.triangles);
    }
    CHECK(bark_repeats(whole, 0.5) == bark_repeats(ended, 0.5));
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
