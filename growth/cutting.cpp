#include "growth/cutting.h"

#include <algorithm>
#include <array>

namespace ramify::growth {
namespace {

constexpr std::uint32_t kNodesAtOnce = 1024;

}  // namespace

std::vector<std::uint32_t> nodes_beyond(const Plant& plant, const std::vector<std::uint32_t>& cuts) {
  std::vector<std::uint32_t> nodes;
  if (cuts.empty()) return nodes;
  std::vector<std::uint8_t> goes(plant.node_count(), 0);
  for (const std::uint32_t cut : cuts) goes[cut] = 1;
  const auto count = static_cast<std::uint32_t>(plant.node_count());
  const std::uint32_t* const parent = plant.parent.data();
  std::uint8_t* const beyond = goes.data();
  // Which nodes go is hard to foretell, so they are told apart without a branch.
  std::array<std::uint32_t, kNodesAtOnce> found;
  for (std::uint32_t node = *std::min_element(cuts.begin(), cuts.end()); node < count;) {
    const std::uint32_t end = std::min(count, node + kNodesAtOnce);
    std::size_t found_count = 0;
    for (; node < end; ++node) {
      const bool is_hole = parent[node] == kNone;
      const auto goes_too = static_cast<std::uint8_t>(beyond[node] | beyond[is_hole ? node : parent[node]]);
      beyond[node] = goes_too;
      found[found_count] = node;
      found_count += goes_too & !is_hole;
    }
    nodes.insert(nodes.end(), found.begin(), found.begin() + found_count);
  }
  return nodes;
}

void follow_growth(const Plant& plant, std::size_t first, std::vector<std::uint32_t>& nodes) {
  if (nodes.empty()) return;
  std::vector<std::uint8_t> goes(plant.node_count(), 0);
  for (const std::uint32_t node : nodes) goes[node] = 1;
  for (std::size_t node = first; node < plant.node_count(); ++node) {
    goes[node] = goes[plant.parent[node]];
    if (goes[node]) nodes.push_back(static_cast<std::uint32_t>(node));
  }
}

void cut_away(Plant& plant, const std::vector<std::uint32_t>& nodes) {
  // From the tips on: an internode that never bore another is one tip.
  for (std::size_t i = nodes.size(); i-- > 0;) {
    const std::uint32_t node = nodes[i];
    plant.lost_tips[plant.parent[node]] += std::max<std::uint32_t>(plant.lost_tips[node], 1);
    plant.parent[node] = kNone;
  }
  plant.cut_nodes += static_cast<std::uint32_t>(nodes.size());
}

}  // namespace ramify::growth
