// A closed surface in pieces, some leaves of a level set each: a quad for each grid edge that it crosses,
// then fewer triangles where it is nearly flat and no other piece has a share in them. T. Ju, T. Udeshi,
// Intersection-free contouring on an octree grid, Pacific Graphics 2006.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "common/mesh/cell_vertices.h"
#include "common/mesh/simplify_closed.h"
#include "common/mesh/wood_voxels.h"

namespace ramify {

/// The triangles of some leaves. They count the piece's own vertices first, then the others'.
struct SurfacePiece {
  CollapsibleMesh mesh;
  std::vector<std::uint32_t> internodes;
  std::uint32_t first_cell = 0;       // cell vertices from here on, up to the next piece's, are its own
  std::vector<std::uint32_t> cells;   // of the own vertices, the cell vertex each was, in ascending order;
                                      // none for those on grid edges, which come last
  std::vector<std::uint32_t> others;  // cell vertices of other pieces
};

/// In the order of the leaves. What is at the border of a piece is left as fine as the voxels: its vertices
/// are not whole. On all threads; the same for any number of them.
std::vector<SurfacePiece> surface_pieces(const WoodVoxels& voxels, const CellVertices& vertices,
                                         double tolerance);

/// In a crease the field has no one gradient: there a vertex that is whole faces as its triangles do.
void mend_normals(CollapsibleMesh& mesh);

/// The values at these places, in memory of just that size.
template <class Values>
void keep_only(const std::vector<std::uint32_t>& kept, Values& values) {
  Values result(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) result[i] = values[kept[i]];
  values = std::move(result);
}

}  // namespace ramify
