#include "common/mesh/normals.h"

namespace ramify {

void compute_normals(Mesh& mesh, std::size_t first_vertex, std::size_t first_triangle) {
  std::vector<Vec3> sums(mesh.vertex_count() - first_vertex, Vec3(0.0));
  for (std::size_t t = first_triangle; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const Vec3 u(mesh.positions[b] - mesh.positions[a]);
    const Vec3 v(mesh.positions[c] - mesh.positions[a]);
    for (const std::uint32_t vertex : {a, b, c}) sums[vertex - first_vertex] += glm::cross(u, v);
  }
  mesh.normals.resize(mesh.vertex_count());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    mesh.normals[first_vertex + i] = Vec3f(normalized_or(sums[i], kUp, 1e-30));
  }
}

}  // namespace ramify
