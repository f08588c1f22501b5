#include "pathplan/tree.h"

#include "tests/catch.h"

using namespace ramify;
using namespace ramify::pathplan;

namespace {

/// A trunk of two metres that forks into a branch of two metres and one of one; node 5 is on no path.
Graph forked_graph() {
  Graph graph;
  graph.nodes = {{0, 0, 0}, {1, 4, 0}, {0, 2, 0}, {-1, 2, 0}, {1, 2, 0}, {9, 9, 9}};
  graph.edges = {{0, 2}, {2, 3}, {2, 4}, {1, 4}, {4, 5}};
  graph.weights = {2.0f, 1.0f, 0.5f, 2.0f, 20.0f};
  link_nodes(graph);
  return graph;
}

Skeleton tree_of(const Graph& graph, const std::vector<std::uint32_t>& endpoints, const Taper& taper) {
  return make_tree(graph, shortest_paths(graph, 0), endpoints, taper);
}

bool is_near(double a, double b) {
  return std::abs(a - b) < 1e-12;
}

}  // namespace

TEST_CASE("tree: it is the union of the paths, by rising cost, and nothing else") {
  const Skeleton tree = tree_of(forked_graph(), {1, 3}, {});
  const std::vector<Vec3> positions = {{0, 0, 0}, {0, 2, 0}, {1, 2, 0}, {-1, 2, 0}, {1, 4, 0}};
  CHECK(tree.position == positions);
  CHECK(tree.parent == std::vector<std::uint32_t>{kNoParent, 0, 1, 1, 2});
  CHECK(tree.level == std::vector<std::uint16_t>(5, 1));
  CHECK(tree.kind == std::vector<Kind>(5, Kind::stem));
  CHECK(violations(tree).empty());
}

TEST_CASE("tree: the longer way is the trunk and the other a branch of it") {
  const Skeleton tree = tree_of(forked_graph(), {1, 3}, {});
  CHECK(tree.order == std::vector<std::uint16_t>{0, 0, 0, 1, 0});
  CHECK(tree.axis_count() == 2);
}

TEST_CASE("tree: widths are the longest way walked to the power zeta, scaled to the trunk") {
  for (const double zeta : {0.0, 0.3, 1.0, 2.0}) {
    const Taper taper{.zeta = zeta, .trunk_diameter = 0.5, .tip_diameter = 0.001};
    const Skeleton tree = tree_of(forked_graph(), {1, 3}, taper);
    CHECK(is_near(tree.diameter[0], 0.5));  // 5 m from the farthest tip
    CHECK(is_near(tree.diameter[1], 0.5 * std::pow(3.0 / 5.0, zeta)));
    CHECK(is_near(tree.diameter[2], 0.5 * std::pow(2.0 / 5.0, zeta)));
    CHECK(is_near(tree.diameter[3], zeta == 0.0 ? 0.5 : 0.001));
  }
}

TEST_CASE("tree: an endpoint on the way to another is walked through") {
  const Skeleton tree = tree_of(forked_graph(), {4, 1, 4}, {.zeta = 1.0, .trunk_diameter = 0.5});
  CHECK(tree.node_count() == 4);
  CHECK(is_near(tree.diameter[2], 0.2));
}

TEST_CASE("tree: a bare root is a sound skeleton") {
  const Skeleton root = bare_root({1, 2, 3}, {.trunk_diameter = 0.5});
  CHECK(violations(root).empty());
  CHECK(root.node_count() == 1);
  CHECK(root.internode_count() == 0);
  CHECK(root.position[0] == Vec3(1, 2, 3));
  CHECK(root.diameter[0] == 0.5);
}
