// Whether triangles make closed surfaces: what printers and level sets ask of a mesh.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/mesh/mesh.h"

namespace ramify::test {

/// What keeps the mesh from being closed 2-manifolds, one sentence each: an edge that is not shared by
/// exactly two triangles in opposite directions, a vertex with more than one fan or none, two vertices in one
/// place, a triangle without area, a normal that is no unit vector or points inwards, a number that is none.
std::vector<std::string> manifold_violations(const Mesh& mesh);

/// The mesh with one vertex where several lie in one place, as textures need them; the first's attributes.
Mesh welded(const Mesh& mesh);

/// Pairs of triangles without a common vertex that cut each other. O(n log n) for a mesh of even triangles.
std::size_t self_intersections(const Mesh& mesh);

/// Pieces that hang together by their triangles.
std::size_t component_count(const Mesh& mesh);

/// Vertices - edges + triangles: 2 for each piece without handles.
long euler_characteristic(const Mesh& mesh);

/// Enclosed by the triangles, positive if they face outwards; m3.
double enclosed_volume(const Mesh& mesh);

}  // namespace ramify::test
