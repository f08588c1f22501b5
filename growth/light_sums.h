// The sums of light that allocation and shedding go by, gathered from the tips to the base.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "growth/plant.h"

namespace ramify::growth {

/// The two sides of a node: the continuation of its axis, and its axillary buds and lateral axes. Numbers,
/// for which way a branch of the tree goes is hard to foretell, so that loops had better not branch on it.
enum Side : std::size_t { kMain, kLateral };

inline Side side_of(const Bud& bud) {
  return static_cast<Side>(!bud.is_terminal);
}

/// Of an internode, seen from its parent.
inline Side side_of(const Plant& plant, std::size_t node) {
  return static_cast<Side>(plant.founds_axis[node]);
}

/// At a node, over its buds and all beyond them.
struct LightSum {
  std::array<double, 2> light{};  // of each side
  std::uint32_t buds = 0;         // how many buds
  std::uint32_t internodes = 0;   // how many living internodes, the node's own included

  double total() const { return light[kMain] + light[kLateral]; }
};

/// `light` has one entry a bud, of which none may be dead. One entry a node. O(nodes).
void sum_light(const Plant& plant, const std::vector<double>& light, std::vector<LightSum>& sums);

/// Sums of a value of buds over the subtree of each node.
std::vector<double> subtree_sums(const Plant& plant, const std::vector<double>& values);

}  // namespace ramify::growth
