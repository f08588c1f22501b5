#include "common/skeleton/passes.h"

#include <algorithm>

#include "common/base/errors.h"
#include "tests/catch.h"
#include "tests/common/trees.h"

using namespace ramify;
using namespace ramify::test;

TEST_CASE("Strahler: a pole has order 1 and a perfect binary tree one more than its depth") {
  CHECK(strahler_orders(pole(5)).front() == 1);
  for (int depth = 1; depth < 8; ++depth) CHECK(strahler_orders(binary_tree(depth)).front() == depth + 1);
}

TEST_CASE("Strahler: a herringbone of single laterals never gets past 2") {
  Skeleton s = pole(10);
  for (std::uint32_t node = 1; node < 10; ++node) {
    s.position.push_back(s.position[node] + Vec3(1, 0, 0));
    s.parent.push_back(node);
    s.diameter.push_back(0.01);
    s.kind.push_back(Kind::stem);
  }
  assign_axes(s);
  CHECK(strahler_orders(s).front() == 2);
}

TEST_CASE("axes: the thickest child continues, the others found axes of the next order") {
  const Skeleton s = binary_tree(3);
  for (std::size_t node = 2; node < s.node_count(); ++node) {
    const bool is_left = node % 2 == 0;  // the thicker one
    CHECK((s.axis[node] == s.axis[s.parent[node]]) == is_left);
    CHECK(s.order[node] == s.order[s.parent[node]] + (is_left ? 0 : 1));
  }
}

TEST_CASE("axes: of equally thick children the one with more wood beyond it continues") {
  Skeleton s = pole(1);
  const auto add = [&](std::uint32_t parent, Vec3 step) {
    s.position.push_back(s.position[parent] + step);
    s.parent.push_back(parent);
    s.diameter.push_back(0.05);
    s.kind.push_back(Kind::stem);
  };
  add(1, Vec3(1, 0, 0));
  add(1, Vec3(-1, 0, 0));
  add(3, Vec3(-1, 0, 0));
  assign_axes(s);
  CHECK(s.order[2] == 1);
  CHECK(s.order[3] == 0);
  CHECK(s.order[4] == 0);
}

TEST_CASE("orders follow from the axes alone") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Skeleton s = random_tree(seed, 300);
    const std::vector<std::uint16_t> expected = s.order;
    assign_orders(s);
    CHECK(s.order == expected);
  }
}

TEST_CASE("pipe model: a fork's areas add up to the parent's") {
  Skeleton s = binary_tree(4);
  assign_pipe_diameters(s, {.exponent = 2.0, .tip_diameter = 0.01});
  CHECK(s.diameter.back() == 0.01);
  CHECK(std::abs(s.diameter[0] - 0.04) < 1e-15);  // sqrt(16) tips
}

TEST_CASE("pipe model: the rule holds at every node of any tree and exponent") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (const double n : {2.0, 2.5, 3.0}) {
      Skeleton s = random_tree(seed, 500);
      assign_pipe_diameters(s, {.exponent = n, .tip_diameter = 0.02});
      std::vector<double> sums(s.node_count(), 0.0);
      for (std::size_t i = 1; i < s.node_count(); ++i) sums[s.parent[i]] += std::pow(s.diameter[i], n);
      for (std::size_t i = 0; i < s.node_count(); ++i) {
        const double expected = sums[i] > 0 ? sums[i] : std::pow(0.02, n);
        CHECK(std::abs(std::pow(s.diameter[i], n) - expected) <= 1e-9 * expected);
      }
    }
  }
}

TEST_CASE("pipe model: an exponent that is not positive is refused") {
  Skeleton s = pole(1);
  try {
    assign_pipe_diameters(s, {.exponent = 0.0});
    FAIL("nothing thrown");
  } catch (const InputError& error) {
    CHECK(std::string(error.what()) == "pipe model: exponent 0 (must be greater than 0)");
  }
}

TEST_CASE("cut: the tree after a step holds what was born by then and not yet shed") {
  const Skeleton history = random_tree(4, 400);
  for (const std::uint32_t step : {0u, 3u, 5u, 105u}) {
    const Skeleton past = cut_at_step(history, step);
    std::size_t expected = 0;
    for (std::size_t i = 0; i < history.node_count(); ++i) {
      const bool is_shed_by_then = history.shed_step[i] != kAlive && history.shed_step[i] <= step;
      if (history.birth_step[i] <= step && !is_shed_by_then) ++expected;
    }
    CHECK(past.node_count() == expected);
    CHECK(violations(past).empty());
    CHECK(past.light.empty());
    for (const std::uint32_t shed : past.shed_step) CHECK(shed == kAlive);
  }
}

TEST_CASE("cut: what is shed goes on holding its branch at the width it had") {
  Skeleton history = binary_tree(2);
  history.birth_step = {0, 1, 2, 2, 3, 3, 3, 3};
  history.shed_step = {0, 0, 0, 4, 0, 0, 4, 4};
  assign_pipe_diameters(history, {.exponent = 2.0, .tip_diameter = 1.0});
  CHECK(cut_at_step(history, 2).diameter.front() == std::sqrt(2.0));
  CHECK(cut_at_step(history, 3).diameter.front() == 2.0);
  const Skeleton last = cut_at_step(history, 4);
  CHECK(last.diameter.front() == 2.0);
  CHECK(last.internode_count() == 4);
  CHECK(cut_at_step(history, 4, true).internode_count() == 7);
}

TEST_CASE("steps: the last one is when something grew or fell, or the last level") {
  CHECK(last_step(pole(3)) == 0);
  Skeleton history = binary_tree(1);
  history.birth_step = {0, 1, 2, 2};
  CHECK(last_step(history) == 2);
  history.shed_step = {0, 0, 0, 5};
  CHECK(last_step(history) == 5);
  Skeleton planned = binary_tree(1);
  planned.level = {1, 1, 3, 2};
  CHECK(last_step(planned) == 3);
}

TEST_CASE("steps: a tree is cut at a step or, where it has none, at a level") {
  Skeleton history = binary_tree(1);
  history.birth_step = {0, 1, 2, 3};
  CHECK(cut_at(history, 2).internode_count() == 2);
  Skeleton planned = binary_tree(1);
  planned.level = {1, 1, 3, 2};
  CHECK(cut_at(planned, 2).internode_count() == 2);
}
