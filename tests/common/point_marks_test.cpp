#include "common/mesh/point_marks.h"

#include <algorithm>

#include "common/mesh/axes.h"
#include "common/mesh/tube_plan.h"
#include "growth/engine.h"
#include "tests/catch.h"
#include "tests/common/trees.h"

using namespace ramify;
using namespace ramify::test;

namespace {

/// A trunk of 2 m, 2 cm thick, and at its middle a twig that is 1 cm thick, its points counted from there.
Skeleton trunk_and_twig(const std::vector<Vec3>& twig) {
  Skeleton s;
  add_node(s, {0, 0, 0}, kNoParent, 0.02);
  add_node(s, {0, 1, 0}, 0, 0.02);
  add_node(s, {0, 2, 0}, 1, 0.02);
  std::uint32_t parent = 1;
  for (const Vec3& point : twig) {
    add_node(s, Vec3(0, 1, 0) + point, parent, 0.01);
    parent = static_cast<std::uint32_t>(s.node_count() - 1);
  }
  s.axis.assign(s.node_count(), 1);
  s.axis[0] = s.axis[1] = s.axis[2] = 0;
  return s;
}

std::vector<int> twig_marks(const std::vector<Vec3>& twig) {
  const Axes axes = find_axes(trunk_and_twig(twig));
  REQUIRE(axes.list.size() == 2);
  const Axis& axis = axes.list[1];
  return {axes.marks.begin() + axis.first, axes.marks.begin() + axis.end()};
}

}  // namespace

TEST_CASE("point marks: an even twig has none, what is uneven is marked where it is") {
  CHECK(twig_marks({{0.5, 0, 0}, {1, 0.1, 0}, {1.5, 0.2, 0}, {2, 0.3, 0}}) == std::vector{0, 0, 0, 0, 0});
  CHECK(twig_marks({{0.5, 0, 0}, {1, 0.5, 0}, {1.5, 1, 0}}) == std::vector<int>{0, kBends, 0, 0});
  CHECK(twig_marks({{0.5, 0, 0}, {0.2, 0.3, 0}, {-0.1, 0.6, 0}}) ==
        std::vector<int>{0, kBends | kTurnsBack, 0, 0});
  CHECK(twig_marks({{0.5, 0, 0}, {1, 0, 0}, {1.007, 0, 0}}) == std::vector<int>{0, 0, 0, kIsCrowded});
  CHECK(twig_marks({{0.025, 0, 0}, {0.5, 0, 0}}) == std::vector<int>{0, kIsNear, 0});
  CHECK(twig_marks({{0.5, -0.5, 0}, {1, -0.999, 0}}) == std::vector<int>{0, 0, kIsLow});
}

TEST_CASE("point marks: tubes planned by them are those planned point by point") {
  const auto check_plans = [](const Skeleton& tree, const MesherOptions& options) {
    Axes axes = find_axes(tree);
    const TubePlan quick = plan_tubes(tree, axes, options);
    std::ranges::fill(axes.marks, std::uint8_t{kIsCrowded | kBends | kIsLow | kIsNear});
    const TubePlan slow = plan_tubes(tree, axes, options);
    CHECK(quick.tubes == slow.tubes);
    CHECK(quick.rings == slow.rings);
    CHECK(quick.vertex_count == slow.vertex_count);
    CHECK(quick.triangle_count == slow.triangle_count);
  };
  growth::Parameters parameters;
  parameters.steps = 12;
  const Skeleton grown = growth::Engine::run(parameters, {}).skeleton;
  for (const int sides_min : {3, 4}) {
    check_plans(grown, {.sides_min = sides_min});
    check_plans(grown, {.centre_line = CentreLine::catmull_rom, .sides_min = sides_min});
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      for (const double thickness : {1.0, 0.5, 0.2, 0.05}) {
        Skeleton tree = random_tree(seed, 3000);
        for (double& diameter : tree.diameter) diameter *= thickness;
        check_plans(tree, {.sides_min = sides_min});
      }
    }
  }
}
