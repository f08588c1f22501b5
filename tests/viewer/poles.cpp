#include "tests/viewer/poles.h"

namespace ramify::test {

Skeleton pole_of(int internodes, double height, double diameter) {
  Skeleton skeleton;
  for (int node = 0; node <= internodes; ++node) {
    skeleton.position.emplace_back(0.0, height * node / internodes, 0.0);
    skeleton.parent.push_back(node == 0 ? kNoParent : static_cast<std::uint32_t>(node - 1));
  }
  skeleton.diameter.assign(skeleton.node_count(), diameter);
  skeleton.axis.assign(skeleton.node_count(), 0);
  skeleton.order.assign(skeleton.node_count(), 0);
  skeleton.kind.assign(skeleton.node_count(), Kind::stem);
  return skeleton;
}

Mesh tube_mesh(const Skeleton& skeleton) {
  constexpr std::uint32_t kSides = 24;
  Mesh mesh;
  for (std::size_t node = skeleton.root_count(); node < skeleton.node_count(); ++node) {
    const Vec3 along = normalized_or(skeleton.along(node), kUp);
    const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
    for (const Vec3& center : {skeleton.position[skeleton.parent[node]], skeleton.position[node]}) {
      for (std::uint32_t side = 0; side <= kSides; ++side) {
        const Vec3 normal = perpendicular_at(along, 2.0 * std::numbers::pi * side / kSides);
        mesh.positions.emplace_back(center + 0.5 * skeleton.diameter[node] * normal);
        mesh.normals.emplace_back(normal);
        mesh.uvs.emplace_back(static_cast<float>(side) / kSides, 0.0f);
        mesh.internodes.push_back(static_cast<std::uint32_t>(node));
      }
    }
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const std::uint32_t low = first + side;
      const std::uint32_t high = low + kSides + 1;
      mesh.triangles.push_back({low, low + 1, high + 1});
      mesh.triangles.push_back({low, high + 1, high});
    }
  }
  if (!mesh.triangles.empty()) {
    mesh.materials.resize(1);
    mesh.ranges = {{0, 0, mesh.triangles.size()}};
  }
  return mesh;
}

}  // namespace ramify::test
