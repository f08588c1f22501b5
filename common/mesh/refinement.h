// Triangles made smaller where something changes too much along them.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "common/mesh/mesh.h"

namespace ramify {

/// Two vertices, the lesser first.
using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// What refine() asks about edges.
struct EdgeRules {
  std::function<bool(const Edge&)> is_coarse;  // whether it is to be halved
  std::function<float(const Edge&)> length;
  std::function<std::uint32_t(const Edge&)> add_middle;  // makes a vertex there, and returns it
};

/// Halves the longest edge of each triangle that has a coarse one, and all triangles at such edges with them:
/// where triangles met edge to edge they still do. Returns whether there were any; what is then still coarse
/// wants another call. O(n log n). M.-C. Rivara, Algorithms for refining triangular grids suitable for
/// adaptive and multigrid techniques, Int. J. Numer. Methods Eng. 20, 1984.
bool refine(std::vector<Triangle>& triangles, const EdgeRules& rules);

}  // namespace ramify
