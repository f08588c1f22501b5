// The surface of a field of wood as one closed 2-manifold that does not cut itself.
// The field is rasterised into an OpenVDB level set near its surface; a few voxels are filled so that the
// inside is well-composed; then each cell that the surface passes has one vertex, each grid edge it crosses a
// quad. K. Museth, VDB: High-Resolution Sparse Volumes with Dynamic Topology, ACM Trans. Graph. 32(3), 2013.
// L. Latecki, U. Eckhardt, A. Rosenfeld, Well-composed sets, Comput. Vis. Image Underst. 61(1), 1995.
// T. Ju, T. Udeshi, Intersection-free contouring on an octree grid, Pacific Graphics 2006.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/mesh/mesh.h"
#include "common/mesh/wood_field.h"

namespace ramify {

/// Active voxels of a level set: those within so many voxels of the surface.
inline constexpr double kBandVoxels = 2.0;

struct ClosedSurface {
  BulkVector<Vec3f> positions;
  BulkVector<Vec3f> normals;             // the field's gradient
  BulkVector<std::uint32_t> internodes;  // the nearest
  BulkVector<std::array<std::uint32_t, 3>> triangles;
  std::size_t active_voxels = 0;
};

/// Every edge is shared by exactly two triangles in opposite directions, every vertex has one fan; vertices
/// lie in the field's surface within a twentieth of a voxel. Wood thinner than two voxels may break up.
/// Hollows closed off all around are filled. On all threads; the same for any number of them. Throws RunError
/// if the grid would be too wide for 32-bit indices.
ClosedSurface closed_surface(const WoodField& field, double voxel_size);

/// Drops the vertices that no triangle uses; the others keep their order. Returns which ones they were.
std::vector<std::uint32_t> drop_unused_vertices(ClosedSurface& surface);

}  // namespace ramify
