// Levels of detail: how much of a tree's surface may go for a mesh of so many triangles.
#pragma once

#include <functional>
#include <vector>

#include "common/mesh/mesher.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// The triangles that a mesh of `full` in the finest detail may have: a third for each level, and no more
/// than options.max_triangles.
std::size_t triangle_budget(std::size_t full, const MesherOptions& options);

/// About the least tolerance, metres, with which a tree's mesh keeps to the budget; `count` says how many
/// triangles it has with one. 16 calls of count(). Throws InputError if even the trunk alone has more.
double least_tolerance(const Skeleton& skeleton, std::size_t budget,
                       const std::function<std::size_t(double tolerance)>& count);

/// Which nodes stay: those of the axes from which the tree reaches farther than `tolerance`, metres, with all
/// that they bear. Trunks stay. O(n).
std::vector<bool> kept_axes(const Skeleton& skeleton, double tolerance);

/// Sides of a tube, no more than `sides`, whose middles lie at most `tolerance` inside its circle; at
/// least 3.
std::uint32_t sides_within(std::uint32_t sides, double radius, double tolerance);

}  // namespace ramify
