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

/// Something of each side of a node.
using Sides = std::array<double, 2>;

/// At each node, over its buds and all beyond them.
struct LightSums {
  MappedVector<Sides> light;
  MappedVector<std::uint32_t> internodes;  // how many living ones, the node's own included

  double total(std::size_t node) const { return light[node][kMain] + light[node][kLateral]; }
};

/// `light` has one entry a bud, of which none may be dead. O(nodes).
void sum_light(const Plant& plant, const MappedVector<double>& light, LightSums& sums);

/// How many buds each node and all beyond it have. O(nodes).
std::vector<std::uint32_t> bud_counts(const Plant& plant);

/// Sums of a value of buds over the subtree of each node.
std::vector<double> subtree_sums(const Plant& plant, const MappedVector<double>& values);

}  // namespace ramify::growth
