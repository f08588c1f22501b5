// Where the wood of two axes meets.
#pragma once

#include <cstdint>
#include <vector>

#include "common/skeleton/skeleton.h"

namespace ramify {

/// A lateral and older wood: its bearer, a lateral that leaves that beside it or comes by there or, where the
/// bearer has just begun, what bears that.
struct Joint {
  std::uint32_t lateral = 0;  // its first node
  std::uint32_t older = 0;    // a node of the older axis, near
  float radius = 0.0f;        // of the lateral, metres
  float older_radius = 0.0f;
  float reach = 0.0f;  // from the fork, metres: what lies farther has nothing to do with it
  std::vector<std::uint32_t> lateral_nodes;  // of internodes within reach
  std::vector<std::uint32_t> older_nodes;
};

/// Those of laterals thick enough for a collar, in the order of their nodes. O(n), and what beside each
/// lateral leaves the same axes.
std::vector<Joint> find_joints(const Skeleton& skeleton);

}  // namespace ramify
