#include "growth/history.h"

namespace ramify::growth {

void History::record(Plant& plant, std::size_t first) {
  for (std::size_t node = first; node < plant.node_count(); ++node) {
    const Axis& axis = plant.axes[plant.axis[node]];
    plant.id.push_back(static_cast<std::uint32_t>(position.size()));
    position.push_back(plant.position[node]);
    parent.push_back(node == 0 ? kNone : plant.id[plant.parent[node]]);
    axis_id.push_back(axis.id);
    order.push_back(axis.order);
    birth_step.push_back(plant.birth_step[node]);
    shed_step.push_back(kAlive);
  }
}

}  // namespace ramify::growth
