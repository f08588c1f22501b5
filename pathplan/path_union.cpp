#include "pathplan/path_union.h"

#include <algorithm>
#include <cassert>

#include "common/skeleton/skeleton.h"

namespace ramify::pathplan {

PathUnion::PathUnion(std::size_t graph_nodes)
    : nodes_{0}, parents_{kNoParent}, place_(graph_nodes, kNoPlace) {
  place_[0] = 0;
}

void PathUnion::add(const ShortestPaths& paths, std::span<const std::uint32_t> endpoints) {
  constexpr std::uint32_t kComing = kNoPlace - 1;
  const std::size_t before = nodes_.size();
  for (std::uint32_t node : endpoints) {
    assert(paths.is_reached(node));
    for (; place_[node] == kNoPlace; node = paths.parent[node]) {
      place_[node] = kComing;
      nodes_.push_back(node);
    }
  }
  // Every edge adds to the cost, so parents come first.
  std::sort(nodes_.begin() + static_cast<std::ptrdiff_t>(before), nodes_.end(),
            [&](std::uint32_t a, std::uint32_t b) {
              return paths.cost[a] < paths.cost[b] || (paths.cost[a] == paths.cost[b] && a < b);
            });
  for (std::size_t i = before; i < nodes_.size(); ++i) {
    place_[nodes_[i]] = static_cast<std::uint32_t>(i);
    parents_.push_back(place_[paths.parent[nodes_[i]]]);
  }
}

}  // namespace ramify::pathplan
