#include "pathplan/path_union.h"

#include "tests/catch.h"
#include "tests/pathplan/graphs.h"

using namespace ramify;
using namespace ramify::pathplan;
using namespace ramify::test;

namespace {

/// A trunk of two metres that forks into a branch of two metres and one of one; node 5 hangs on the longer.
Graph forked_graph() {
  return graph_of({{0, 0, 0}, {1, 4, 0}, {0, 2, 0}, {-1, 2, 0}, {1, 2, 0}, {9, 9, 9}},
                  {{0, 2}, {2, 3}, {2, 4}, {1, 4}, {4, 5}}, {2.0f, 1.0f, 0.5f, 2.0f, 20.0f});
}

using Numbers = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("paths' union: it is the paths, parents first, and nothing else") {
  const ShortestPaths paths = shortest_paths(forked_graph(), kRoot);
  PathUnion branches(6);
  CHECK(branches.nodes() == Numbers{0});
  branches.add(paths, Numbers{1, 3});
  CHECK(branches.nodes() == Numbers{0, 2, 4, 3, 1});
  CHECK(branches.parents() == Numbers{kNoParent, 0, 1, 1, 2});
  CHECK(branches.place(3) == 3);
  CHECK(branches.contains(4));
  CHECK_FALSE(branches.contains(5));
}

TEST_CASE("paths' union: an endpoint on the way to another, or given twice, adds nothing") {
  const ShortestPaths paths = shortest_paths(forked_graph(), kRoot);
  PathUnion branches(6);
  branches.add(paths, Numbers{1, 4, 1});
  CHECK(branches.nodes() == Numbers{0, 2, 4, 1});
  branches.add(paths, Numbers{2});
  CHECK(branches.nodes().size() == 4);
}

TEST_CASE("paths' union: paths searched from it later join it where they meet it") {
  const Graph graph = forked_graph();
  PathUnion branches(6);
  branches.add(shortest_paths(graph, kRoot), Numbers{1});
  const ShortestPaths later = shortest_paths(graph, branches.nodes());
  CHECK(later.cost[1] == 0.0);
  branches.add(later, Numbers{5, 3});
  CHECK(branches.nodes() == Numbers{0, 2, 4, 1, 3, 5});
  CHECK(branches.parents() == Numbers{kNoParent, 0, 1, 2, 1, 2});
}
