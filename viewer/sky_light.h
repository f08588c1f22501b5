// How much of the sky is seen from within and around a crown: the cheap ambient darkening that gives it
// depth.
#pragma once

#include <cstdint>
#include <vector>

#include "common/base/geometry.h"
#include "common/mesh/mesh.h"

namespace ramify {

/// Cells over a box, x fastest, then y, then z. Outside it the whole sky is seen.
struct SkyLight {
  Box box;
  Coord size{0};
  std::vector<std::uint8_t> visibility;  // at the cells' centres: 255 is the whole sky, 0 none

  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * size.y + y) * size.x + x;
  }
};

/// Light from a few directions is weakened by the wood that it crosses, as in a turbid medium (Beer-Lambert;
/// leafless wood as randomly oriented surfaces, that is a cross-section of a quarter of its area). The box
/// reaches from `ground` to the top of the mesh; empty for an empty mesh. O(triangles + cells).
SkyLight sky_light(const Mesh& mesh, double ground);

}  // namespace ramify
