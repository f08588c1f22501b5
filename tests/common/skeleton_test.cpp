#include "common/skeleton/skeleton.h"

#include <functional>

#include "tests/catch.h"
#include "tests/common/trees.h"

using namespace ramify;
using namespace ramify::test;

TEST_CASE("skeleton: sound trees have no violations") {
  CHECK(violations(pole(1)).empty());
  CHECK(violations(binary_tree(5)).empty());
  for (std::uint64_t seed = 0; seed < 20; ++seed) CHECK(violations(random_tree(seed, 200)).empty());
}

TEST_CASE("skeleton: each violation is a sentence with index, value and limit") {
  struct Case {
    const char* sentence;
    std::function<void(Skeleton&)> spoil;
  };
  const std::vector<Case> cases = {
      {"skeleton: no nodes (there is at least a root)", [](Skeleton& s) { s = Skeleton{}; }},
      {"skeleton: diameter has 3 entries (one a node: 4)", [](Skeleton& s) { s.diameter.pop_back(); }},
      {"skeleton: channel has 1 entries (one a node: 4)", [](Skeleton& s) { s.channels["channel"] = {1.0}; }},
      {"skeleton node 2: parent 3 is not before it (nodes follow their parent)",
       [](Skeleton& s) { s.parent[2] = 3; }},
      {"skeleton node 2: a root after internodes (roots come first)",
       [](Skeleton& s) { s.parent[2] = kNoParent; }},
      {"skeleton: node 0 has a parent (roots come first)", [](Skeleton& s) { s.parent[0] = 0; }},
      {"skeleton node 1: position is not finite", [](Skeleton& s) { s.position[1].x = std::nan(""); }},
      {"skeleton node 3: diameter 0 (must be greater than 0)", [](Skeleton& s) { s.diameter[3] = 0; }},
      {"skeleton node 3: order 2 on an axis of order 0 (one order an axis)",
       [](Skeleton& s) { s.order[3] = 2; }},
      {"skeleton node 3: order 0 on a lateral axis (only the trunk has order 0)",
       [](Skeleton& s) { s.axis[3] = 9; }},
      {"skeleton node 3: a second continuation of axis 0 at node 1 (an axis is a chain)",
       [](Skeleton& s) { s.parent[3] = 1; }},
      {"skeleton node 2: born at step 1, before its parent 1 at step 5",
       [](Skeleton& s) {
         s.birth_step = {0, 5, 1, 5};
       }},
      {"skeleton node 2: outlives its parent 1, shed at step 4",
       [](Skeleton& s) {
         s.shed_step = {0, 4, 0, 0};
       }},
  };
  for (const Case& c : cases) {
    Skeleton skeleton = pole(3);
    c.spoil(skeleton);
    const std::vector<std::string> found = violations(skeleton);
    REQUIRE_FALSE(found.empty());
    CHECK(found.front() == c.sentence);
  }
}

TEST_CASE("skeleton: violations stop at the limit asked for") {
  Skeleton skeleton = pole(100);
  for (double& d : skeleton.diameter) d = -1;
  CHECK(violations(skeleton, 3).size() == 3);
}

TEST_CASE("skeleton: counts of nodes, internodes and axes") {
  CHECK(pole(4).internode_count() == 4);
  CHECK(pole(4).axis_count() == 1);
  CHECK(binary_tree(3).internode_count() == 15);
  CHECK(binary_tree(3).axis_count() == 8);  // every tip ends one
}

TEST_CASE("skeleton: a subset keeps every attribute of the nodes it keeps") {
  const Skeleton tree = random_tree(3, 50);
  std::vector<bool> keep(tree.node_count(), false);
  keep[0] = true;
  for (std::size_t i = 1; i < keep.size(); ++i) keep[i] = keep[tree.parent[i]] && i % 7 != 0;
  const Skeleton part = subset(tree, keep);
  CHECK(violations(part).empty());
  std::size_t at = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    CHECK(part.position[at] == tree.position[i]);
    CHECK(part.light[at] == tree.light[i]);
    CHECK(part.axis[at] == tree.axis[i]);
    if (i > 0) CHECK(part.position[part.parent[at]] == tree.position[tree.parent[i]]);
    ++at;
  }
  CHECK(at == part.node_count());
}
