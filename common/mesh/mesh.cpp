#include "common/mesh/mesh.h"

#include <algorithm>

namespace ramify {

SolidPart solid_part(const Mesh& mesh) {
  SolidPart solid{mesh.vertex_count(), mesh.triangles.size()};
  for (const MaterialRange& range : mesh.ranges) {
    if (!mesh.material(range).is_overlay) continue;
    solid.triangle_count = range.first_triangle;
    for (std::size_t t = range.first_triangle; t < mesh.triangles.size(); ++t) {
      const Triangle& triangle = mesh.triangles[t];
      solid.vertex_count =
          std::min<std::size_t>(solid.vertex_count, *std::min_element(triangle.begin(), triangle.end()));
    }
    break;
  }
  return solid;
}

}  // namespace ramify
