#include "growth/cutting.h"

#include <algorithm>

namespace ramify::growth {

std::vector<std::uint32_t> nodes_beyond(const Plant& plant, const std::vector<std::uint32_t>& cuts) {
  std::vector<std::uint32_t> nodes;
  if (cuts.empty()) return nodes;
  std::vector<std::uint8_t> goes(plant.node_count(), 0);
  for (const std::uint32_t cut : cuts) goes[cut] = 1;
  const auto count = static_cast<std::uint32_t>(plant.node_count());
  const std::uint32_t* const parent = plant.parent.data();
  std::uint8_t* const beyond = goes.data();
  for (std::uint32_t node = *std::min_element(cuts.begin(), cuts.end()); node < count; ++node) {
    if (parent[node] == kNone) continue;
    beyond[node] |= beyond[parent[node]];
    if (beyond[node]) nodes.push_back(node);
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
