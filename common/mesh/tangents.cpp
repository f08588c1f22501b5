#include "common/mesh/tangents.h"

#include <algorithm>
#include <span>

#include "common/base/parallel.h"

namespace ramify {
namespace {

// Triangles that are looked at, or left out, together.
constexpr std::size_t kBlock = 4096;
constexpr std::size_t kVerticesATask = 1 << 16;  // blocks at its ends are looked at twice

/// Triangles of one material and the vertices they reach: of a mesh built tube by tube, not many.
struct Block {
  std::size_t first = 0;
  std::size_t end = 0;
  std::uint32_t low = 0;  // vertices
  std::uint32_t high = 0;
};

std::vector<Block> blocks_of(const Mesh& mesh) {
  std::vector<Block> blocks;
  for (const MaterialRange& range : mesh.ranges) {
    if (mesh.material(range).normal_map.is_empty()) continue;
    const std::size_t end = range.first_triangle + range.triangle_count;
    for (std::size_t first = range.first_triangle; first < end; first += kBlock) {
      blocks.push_back({first, std::min(first + kBlock, end)});
    }
  }
  parallel_for(blocks.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Block& block = blocks[i];
      block.low = mesh.triangles[block.first][0];
      for (std::size_t t = block.first; t < block.end; ++t) {
        for (const std::uint32_t vertex : mesh.triangles[t]) {
          block.low = std::min(block.low, vertex);
          block.high = std::max(block.high, vertex);
        }
      }
    }
  });
  return blocks;
}

/// How a triangle's surface runs along +u, as long as the triangle is large, and whether the texture lies on
/// it as it is (1) or mirrored (-1).
glm::vec4 slope_along_u(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const auto [a, b, c] = triangle;
  const Vec3f p = mesh.positions[b] - mesh.positions[a];
  const Vec3f q = mesh.positions[c] - mesh.positions[a];
  const Vec2f s = mesh.uvs[b] - mesh.uvs[a];
  const Vec2f t = mesh.uvs[c] - mesh.uvs[a];
  const float turn = s.x * t.y - s.y * t.x;
  const float side = turn < 0.0f ? -1.0f : 1.0f;
  return {side * (p * t.y - q * s.y), side * glm::length(glm::cross(p, q))};
}

glm::vec4 tangent_of(const glm::vec4& sum, const Vec3f& normal) {
  const Vec3f along(sum);
  const Vec3f flat = along - normal * glm::dot(along, normal);
  const float length = glm::length(flat);
  const float side = sum.w < 0.0f ? -1.0f : 1.0f;
  if (length < 1e-20f) return {Vec3f(any_perpendicular(glm::normalize(Vec3(normal)))), side};
  return {flat / length, side};
}

}  // namespace

void compute_tangents(Mesh& mesh) {
  mesh.tangents.clear();
  const std::vector<Block> blocks = blocks_of(mesh);
  if (blocks.empty()) return;
  mesh.tangents.assign(mesh.vertex_count(), glm::vec4(0.0f));  // resize() would leave them unset
  // Each task sums up for its own vertices, in the order of the triangles, whatever block they are in.
  parallel_for(mesh.vertex_count(), kVerticesATask, [&](std::size_t begin, std::size_t end) {
    std::fill(mesh.tangents.begin() + static_cast<std::ptrdiff_t>(begin),
              mesh.tangents.begin() + static_cast<std::ptrdiff_t>(end), glm::vec4(0.0f));
    for (const Block& block : blocks) {
      if (block.high < begin || block.low >= end) continue;
      for (std::size_t t = block.first; t < block.end; ++t) {
        const glm::vec4 slope = slope_along_u(mesh, mesh.triangles[t]);
        for (const std::uint32_t vertex : mesh.triangles[t]) {
          if (vertex >= begin && vertex < end) mesh.tangents[vertex] += slope;
        }
      }
    }
    for (std::size_t vertex = begin; vertex < end; ++vertex) {
      mesh.tangents[vertex] = tangent_of(mesh.tangents[vertex], mesh.normals[vertex]);
    }
  });
}

void append_overlay_tangents(Mesh& mesh) {
  if (mesh.tangents.empty() || mesh.ranges.empty() || !mesh.material(mesh.ranges.back()).is_overlay) return;
  const SolidPart solid = solid_part(mesh);
  std::vector<glm::vec4> sums(mesh.vertex_count() - solid.vertex_count, glm::vec4(0.0f));
  for (const Triangle& triangle : std::span(mesh.triangles).subspan(solid.triangle_count)) {
    const glm::vec4 slope = slope_along_u(mesh, triangle);
    for (const std::uint32_t vertex : triangle) sums[vertex - solid.vertex_count] += slope;
  }
  resize_with_spare(mesh.tangents, mesh.tangents.size() + sums.size());
  glm::vec4* tangents = mesh.tangents.data() + mesh.tangents.size() - sums.size();
  for (std::size_t i = 0; i < sums.size(); ++i)
    tangents[i] = tangent_of(sums[i], mesh.normals[solid.vertex_count + i]);
}

}  // namespace ramify
