// One vertex in each cell of a level set that the surface passes, on the surface.
// T. Ju, T. Udeshi, Intersection-free contouring on an octree grid, Pacific Graphics 2006.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/bulk.h"
#include "common/mesh/wood_voxels.h"

namespace ramify {

/// Vertices stay so far, in voxels, from the walls of their cell, so that no triangle is too thin for floats.
inline constexpr float kCellMargin = 0.05f;

/// There are fewer: their numbers leave one bit free.
inline constexpr std::uint32_t kCellVerticesMax = 0x80000000;

/// The vertices of all cells, leaf by leaf.
struct CellVertices {
  std::vector<CellMask> cells;            // of each leaf, those that have a vertex
  std::vector<std::size_t> first_vertex;  // of each leaf; one more at the end
  BulkVector<Vec3f> positions;            // metres
  BulkVector<Vec3f> normals;              // unit length
  BulkVector<std::uint32_t> internodes;   // the nearest
  BulkVector<std::uint8_t> are_alone;     // no other part of the surface is near

  /// The number of a cell's vertex: the surface must pass it.
  std::uint32_t vertex_of(const Coord& cell, const WoodVoxels& voxels, const VoxelReader& reader) const;
};

/// On all threads; the same for any number of them. Throws RunError if there are kCellVerticesMax or more.
CellVertices place_cell_vertices(const WoodVoxels& voxels, const FieldItems& items);

}  // namespace ramify
