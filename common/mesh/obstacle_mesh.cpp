#include "common/mesh/obstacle_mesh.h"

#include "common/volume/volume_surface.h"

namespace ramify {
Mesh obstacle_mesh(const Job& job, int voxels) {
  Mesh mesh;
  for (const Volume* volume : job.engine->volumes(job.parameters.get()).obstacles) {
    const VolumeSurface surface = surface_of(*volume, voxels);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), surface.positions.begin(), surface.positions.end());
    mesh.normals.insert(mesh.normals.end(), surface.normals.begin(), surface.normals.end());
    for (const auto& [a, b, c] : surface.triangles) {
      mesh.triangles.push_back({first + a, first + b, first + c});
    }
  }
  if (mesh.triangles.empty()) return mesh;
  mesh.uvs.resize(mesh.positions.size(), Vec2f(0.0f));
  mesh.materials.emplace_back().name = "obstacle";
  mesh.ranges.push_back({0, 0, mesh.triangles.size()});
  return mesh;
}

}  // namespace ramify
