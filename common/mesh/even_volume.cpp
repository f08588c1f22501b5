#include "common/mesh/even_volume.h"

namespace ramify {
namespace {

// Cosine of the angle between two vertices' normals from which on there is a crease between them.
constexpr float kCrease = 0.2f;

}  // namespace

void even_volume(const BulkVector<Vec3f>& normals, const BulkVector<Triangle>& triangles,
                 const std::vector<bool>& can_move, BulkVector<Vec3f>& positions) {
  BulkVector<float> sums(positions.size(), 0.0f);  // of depths, by area
  BulkVector<float> areas(positions.size(), 0.0f);
  for (const auto& triangle : triangles) {
    // How deep an edge's middle lies below the surface is an eighth of this; a triangle lies on average as
    // deep as a third of its edges' middles together.
    float depth = 0.0f;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle[i];
      const std::uint32_t b = triangle[(i + 1) % 3];
      if (glm::dot(normals[a], normals[b]) < kCrease) continue;
      depth += glm::dot(normals[a] - normals[b], positions[a] - positions[b]) / 24.0f;
    }
    const Vec3f& corner = positions[triangle[0]];
    const float area =
        glm::length(glm::cross(positions[triangle[1]] - corner, positions[triangle[2]] - corner));
    for (const std::uint32_t vertex : triangle) {
      sums[vertex] += depth * area;
      areas[vertex] += area;
    }
  }
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (can_move[v] && areas[v] > 0.0f) positions[v] += normals[v] * (sums[v] / areas[v]);
  }
}

}  // namespace ramify
