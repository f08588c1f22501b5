// The sums of light that allocation and shedding go by, gathered from the tips to the base.
#pragma once

#include <cstdint>
#include <vector>

#include "growth/plant.h"

namespace ramify::growth {

/// At a node, over its buds and all beyond them.
struct LightSum {
  double main = 0.0;             // light of the continuation of the node's axis
  double lateral = 0.0;          // light of its axillary buds and lateral axes
  double rate = 0.0;             // allocation: resource passed on for each unit of demand
  std::uint32_t buds = 0;        // how many buds
  std::uint32_t internodes = 0;  // how many living internodes, the node's own included

  double total() const { return main + lateral; }
};

/// `light` has one entry a bud; a dead bud's must be 0. One entry a node. O(nodes).
void sum_light(const Plant& plant, const std::vector<double>& light, std::vector<LightSum>& sums);

/// Sums of a value of buds over the subtree of each node.
std::vector<double> subtree_sums(const Plant& plant, const std::vector<double>& values);

}  // namespace ramify::growth
