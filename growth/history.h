// All that a tree ever made, shed wood too: kept only where it is asked for.
#pragma once

#include <cstdint>
#include <vector>

#include "common/skeleton/skeleton.h"
#include "growth/plant.h"

namespace ramify::growth {

/// Nodes in the order of their creation; Plant::id is their place here.
struct History {
  std::vector<Vec3> position;
  std::vector<std::uint32_t> parent;   // kNone: the root
  std::vector<std::uint32_t> axis_id;  // Axis::id
  std::vector<std::uint16_t> order;
  std::vector<std::uint16_t> birth_step;
  std::vector<std::uint16_t> shed_step;  // kAlive while it lives

  /// Takes down the plant's nodes from `first` on, and names them.
  void record(Plant& plant, std::size_t first);
};

}  // namespace ramify::growth
