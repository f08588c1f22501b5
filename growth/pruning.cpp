#include "growth/pruning.h"

namespace ramify::growth {

bool is_due(const PruneEvent& event, int step) {
  if (event.every == 0) return step == event.step;
  return step >= event.step && (step - event.step) % event.every == 0;
}

std::vector<std::uint32_t> pruned_internodes(const Plant& plant, const PruneEvent& event) {
  const Solid solid(event.volume);
  const bool cuts_inside = event.cut == PruneSide::inside;
  std::vector<std::uint32_t> pruned;
  for (std::uint32_t node = 1; node < plant.node_count(); ++node) {
    if (!plant.is_cut(node) && solid.contains(plant.position[node]) == cuts_inside) pruned.push_back(node);
  }
  return pruned;
}

}  // namespace ramify::growth
