// How near points are to a tree, for what is shown around it to fade with the distance.
#pragma once

#include <span>
#include <vector>

#include "common/base/geometry.h"

namespace ramify {

/// One a point: 1 at a node, less with the distance, 0 from `reach` metres on; to a quarter of `reach`. Zeros
/// without nodes. `reach` must be above 0. O(points + nodes) and a grid around the nodes.
std::vector<float> nearness(std::span<const Vec3> points, std::span<const Vec3> nodes, double reach);

}  // namespace ramify
