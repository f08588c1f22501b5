// The surface of a field of wood as one closed 2-manifold that does not cut itself: each cell of a level set
// that the surface passes has one vertex, each grid edge it crosses a quad; then, where it is nearly flat,
// fewer of them.
// T. Ju, T. Udeshi, Intersection-free contouring on an octree grid, Pacific Graphics 2006.
#pragma once

#include <cstddef>
#include <cstdint>

#include "common/mesh/mesh.h"
#include "common/mesh/wood_field.h"

namespace ramify {

struct ClosedSurface {
  BulkVector<Vec3f> positions;
  BulkVector<Vec3f> normals;             // unit length, the field's gradient
  BulkVector<std::uint32_t> internodes;  // the nearest
  BulkVector<Triangle> triangles;
  std::size_t active_voxels = 0;
};

/// Every edge is shared by exactly two triangles in opposite directions, every vertex has one fan. The
/// surface may move by about `tolerance` (metres) to save triangles; where another part of it is near it is
/// left as fine as the voxels. It lies as far outside the field's surface as inside, so that it encloses the
/// field's volume. Wood thinner than two voxels may break up. Hollows closed off all around are filled. On
/// all threads; the same for any number of them. Throws RunError if there would be too many vertices for
/// 32-bit indices.
ClosedSurface closed_surface(const WoodField& field, double voxel_size, double tolerance);

}  // namespace ramify
