#include "pathplan/tree.h"

#include <algorithm>
#include <cassert>

#include "common/skeleton/passes.h"

namespace ramify::pathplan {
namespace {

/// The nodes on the way from the endpoints to the root, by rising cost: parents come first, since every edge
/// adds to the cost.
std::vector<std::uint32_t> nodes_on_paths(const ShortestPaths& paths,
                                          std::span<const std::uint32_t> endpoints) {
  std::vector<bool> is_used(paths.parent.size(), false);
  std::vector<std::uint32_t> used = {0};
  is_used[0] = true;
  for (std::uint32_t node : endpoints) {
    assert(paths.is_reached(node));
    for (; !is_used[node]; node = paths.parent[node]) {
      is_used[node] = true;
      used.push_back(node);
    }
  }
  std::sort(used.begin(), used.end(), [&](std::uint32_t a, std::uint32_t b) {
    return paths.cost[a] < paths.cost[b] || (paths.cost[a] == paths.cost[b] && a < b);
  });
  return used;
}

/// Greatest length walked from a tip to each node, metres.
std::vector<double> walked_lengths(const Skeleton& tree) {
  std::vector<double> walked(tree.node_count(), 0.0);
  for (std::size_t node = tree.node_count(); node-- > 1;) {
    double& below = walked[tree.parent[node]];
    below = std::max(below, walked[node] + tree.length(node));
  }
  return walked;
}

void assign_widths(Skeleton& tree, double edge_length, const Taper& taper) {
  const std::vector<double> walked = walked_lengths(tree);
  const auto width = [&](std::size_t node) { return std::pow(walked[node] / edge_length, taper.zeta); };
  const double scale = taper.trunk_diameter / width(0);
  for (std::size_t node = 0; node < tree.node_count(); ++node) {
    tree.diameter[node] = std::max(taper.tip_diameter, scale * width(node));
  }
}

}  // namespace

Skeleton make_tree(const Graph& graph, const ShortestPaths& paths, std::span<const std::uint32_t> endpoints,
                   const Taper& taper) {
  const std::vector<std::uint32_t> used = nodes_on_paths(paths, endpoints);
  std::vector<std::uint32_t> renumbered(graph.nodes.size(), kNoParent);
  Skeleton tree;
  for (const std::uint32_t node : used) {
    const bool is_root = node == 0;
    renumbered[node] = static_cast<std::uint32_t>(tree.position.size());
    tree.position.push_back(graph.nodes[node]);
    tree.parent.push_back(is_root ? kNoParent : renumbered[paths.parent[node]]);
  }
  tree.kind.assign(used.size(), Kind::stem);
  tree.level.assign(used.size(), 1);
  tree.diameter.assign(used.size(), taper.trunk_diameter);
  if (used.size() > 1) assign_widths(tree, mean_edge_length(graph), taper);
  assign_axes(tree);
  return tree;
}

Skeleton bare_root(const Vec3& position, const Taper& taper) {
  Graph graph;
  graph.nodes = {position};
  return make_tree(graph, {.cost = {0.0}, .parent = {kNoParent}}, {}, taper);
}

}  // namespace ramify::pathplan
