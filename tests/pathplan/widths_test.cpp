#include "pathplan/widths.h"

#include <cmath>

#include "tests/catch.h"

using namespace ramify;
using namespace ramify::pathplan;

namespace {

/// A trunk of two metres that forks into a branch of four metres (two internodes) and one of one.
Skeleton forked_tree() {
  Skeleton tree;
  tree.position = {{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {-1, 2, 0}, {2, 4, 0}};
  tree.parent = {kNoParent, 0, 1, 1, 2};
  return tree;
}

bool is_near(double a, double b) {
  return std::abs(a - b) < 1e-12;
}

}  // namespace

TEST_CASE("widths: the longest way walked to the power zeta, scaled to the trunk") {
  for (const double zeta : {0.0, 0.3, 1.0, 2.0}) {
    for (const double edge : {0.1, 1.0}) {  // one level: the unit changes nothing
      Skeleton tree = forked_tree();
      const std::vector<TaperedTips> tips = {{.nodes = {3, 4}, .zeta = zeta}};
      assign_tapered_widths(tree, tips, edge, 0.6, 0.001);
      CHECK(is_near(tree.diameter[0], 0.6));  // 6 m from the farthest tip
      CHECK(is_near(tree.diameter[1], 0.6 * std::pow(4.0 / 6.0, zeta)));
      CHECK(is_near(tree.diameter[2], 0.6 * std::pow(2.0 / 6.0, zeta)));
      CHECK(is_near(tree.diameter[3], zeta == 0.0 ? 0.6 : 0.001));
    }
  }
}

TEST_CASE("widths: each level proposes with a zeta of its own, and the largest proposal stays") {
  Skeleton tree = forked_tree();
  // Level 1 ends at the fork; level 2 at the tips. s of the trunk is 2 / 0.5 = 4 and 6 / 0.5 = 12.
  const std::vector<TaperedTips> tips = {{.nodes = {1}, .zeta = 2.0}, {.nodes = {3, 4}, .zeta = 0.5}};
  assign_tapered_widths(tree, tips, 0.5, 1.6, 0.001);
  CHECK(is_near(tree.diameter[0], 1.6));                          // 16, of level 1
  CHECK(is_near(tree.diameter[1], 1.6 / 16.0 * std::sqrt(8.0)));  // of level 2: level 1 proposes 0
  CHECK(is_near(tree.diameter[2], 1.6 / 16.0 * 2.0));
}

TEST_CASE("widths: the pipe model adds up the tips, scaled to the trunk and no thinner than a tip") {
  Skeleton tree = forked_tree();
  assign_piped_widths(tree, 2.0, 0.8, 0.001);
  CHECK(is_near(tree.diameter[0], 0.8));
  CHECK(is_near(tree.diameter[1], 0.8));
  CHECK(is_near(tree.diameter[2], 0.8 / std::sqrt(2.0)));
  CHECK(is_near(tree.diameter[3], 0.8 / std::sqrt(2.0)));
  CHECK_FALSE(tree.pipe_model);
  assign_piped_widths(tree, 2.0, 0.8, 0.7);
  CHECK(is_near(tree.diameter[4], 0.7));
}

TEST_CASE("widths: a root alone is as wide as the trunk") {
  Skeleton root;
  root.position = {{1, 2, 3}};
  root.parent = {kNoParent};
  assign_tapered_widths(root, {}, 0.0, 0.5, 0.01);
  CHECK(root.diameter == std::vector<double>{0.5});
}
