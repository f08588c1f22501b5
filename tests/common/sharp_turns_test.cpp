#include "common/mesh/sharp_turns.h"

#include "common/mesh/point_marks.h"
#include "tests/catch.h"
#include "tests/common/trees.h"

using namespace ramify;
using namespace ramify::test;

namespace {

/// Up for 2 m, then turning by so much in a plane, on for 2 m; a lateral of that part at its middle, and one
/// at the turn.
Skeleton turning(double turn_deg) {
  Skeleton s;
  add_node(s, {0, 0, 0}, kNoParent, 0.2);
  add_node(s, {0, 1, 0}, 0, 0.2);
  add_node(s, {0, 2, 0}, 1, 0.2);
  const Vec3 on(std::sin(radians(turn_deg)), std::cos(radians(turn_deg)), 0);
  add_node(s, s.position[2] + on, 2, 0.18);
  add_node(s, s.position[3] + on, 3, 0.16);
  add_node(s, s.position[3] + Vec3(0, 0, 1), 3, 0.05);
  add_node(s, s.position[2] + Vec3(0, 0, 1), 2, 0.05);
  s.axis = {0, 0, 0, 0, 0, 1, 2};
  return s;
}

}  // namespace

TEST_CASE("sharp turns: an axis that turns back ends there, what follows leaves it as a lateral") {
  Axes axes = find_axes(turning(140.0));
  REQUIRE(axes.list.size() == 3);
  part_sharp_turns(axes);
  REQUIRE(axes.list.size() == 4);
  const Axis& below = axes.list[0];
  const Axis& beyond = axes.list[1];
  CHECK(below.is_trunk());
  CHECK(below.count == 3);
  CHECK(beyond.count == 3);
  CHECK(beyond.bearer == 0);
  CHECK(beyond.base == below.end() - 1);
  CHECK(beyond.bearer_radius == Approx(0.1f));
  CHECK(axes.points[beyond.first].position == Vec3f(0, 2, 0));
  CHECK(axes.points[beyond.first].radius == Approx(0.09f));
  // What grew on the second part does so still, what grew at the turn grows at the first one's end.
  CHECK(axes.list[2].bearer == 1);
  CHECK(axes.points[axes.list[2].base].node == 3);
  CHECK(axes.list[3].bearer == 0);
  CHECK(axes.list[3].base == below.end() - 1);
}

TEST_CASE("sharp turns: axes that bend less stay whole") {
  for (const double turn_deg : {0.0, 60.0, 90.0, 110.0}) {
    Axes axes = find_axes(turning(turn_deg));
    part_sharp_turns(axes);
    CHECK(axes.list.size() == 3);
    CHECK(axes.points.size() == 9);
  }
}

TEST_CASE("sharp turns: parted axes of random trees hold each internode once and begin at their bearers") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Skeleton s = random_tree(seed, 300);
    Axes axes = find_axes(s);
    const std::size_t whole = axes.list.size();
    part_sharp_turns(axes);
    CHECK(axes.list.size() > whole);
    std::vector<int> found(s.node_count(), 0);
    std::uint32_t next = 0;
    for (const Axis& axis : axes.list) {
      CHECK(axis.first == next);
      next = axis.end();
      REQUIRE(axis.count >= 2);
      for (std::uint32_t point = axis.first + 1; point < axis.end(); ++point) {
        ++found[axes.points[point].node];
        CHECK(s.parent[axes.points[point].node] == axes.points[point - 1].node);
      }
      CHECK(axes.points[axis.base].node == axes.points[axis.first].node);
      CHECK(axis.bearer_radius == axes.points[axis.base].radius);
      if (axis.is_trunk()) continue;
      CHECK(axis.base >= axes.list[axis.bearer].first);
      CHECK(axis.base < axes.list[axis.bearer].end());
    }
    CHECK(next == axes.points.size());
    for (std::uint32_t point = 0; point < next; ++point) CHECK((axes.marks[point] & kTurnsBack) == 0);
    for (const std::uint32_t i : axes.at_roots) CHECK(s.is_root(axes.points[axes.list[i].first].node));
    for (std::size_t node = 0; node < s.node_count(); ++node) CHECK(found[node] == (s.is_root(node) ? 0 : 1));
  }
}
