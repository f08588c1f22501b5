#include "pathplan/threshold_graph.h"

#include "common/base/parallel.h"
#include "pathplan/point_grid.h"

namespace ramify::pathplan {
namespace {

// Nodes a task.
constexpr std::size_t kGrain = 1024;

}  // namespace

std::vector<Edge> threshold_edges(std::span<const Vec3> nodes, const EdgeRules& rules, std::stop_token stop) {
  const double reach = rules.max_length();
  const PointGrid grid(nodes, reach);
  std::vector<std::vector<Edge>> found((nodes.size() + kGrain - 1) / kGrain);
  const auto add_edges = [&](std::uint32_t node, std::vector<Edge>& edges) {
    const Box around{nodes[node] - reach, nodes[node] + reach};
    grid.for_each_run(grid.touching(around), [&](std::span<const std::uint32_t> run) {
      for (const std::uint32_t other : run) {
        const Vec3 d = nodes[other] - nodes[node];
        if (other <= node || glm::dot(d, d) > reach * reach || !rules.allows(node, other)) continue;
        edges.push_back({node, other});
      }
    });
  };
  parallel_for(found.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t task = begin; task < end && !stop.stop_requested(); ++task) {
      const std::size_t last = std::min(nodes.size(), (task + 1) * kGrain);
      for (std::size_t node = task * kGrain; node < last; ++node) {
        add_edges(static_cast<std::uint32_t>(node), found[task]);
      }
    }
  });

  std::vector<Edge> edges;
  for (const std::vector<Edge>& some : found) edges.insert(edges.end(), some.begin(), some.end());
  return edges;
}

}  // namespace ramify::pathplan
