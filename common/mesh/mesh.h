// A triangle mesh with the attributes that files and the renderer use.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/base/geometry.h"

namespace ramify {

/// A run of triangles that share a material.
struct MaterialRange {
  std::string material;  // "bark", "leaf"
  std::size_t first_triangle = 0;
  std::size_t triangle_count = 0;
};

/// Triangles are counter-clockwise seen from outside.
struct Mesh {
  std::vector<Vec3f> positions;  // metres
  std::vector<Vec3f> normals;    // unit length, one a vertex
  std::vector<Vec2f> uvs;        // one a vertex: u once around the branch, v along it, one unit a girth
  std::vector<std::uint32_t> internodes;  // the skeleton node that each vertex belongs to
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<MaterialRange> ranges;  // in order, covering all triangles

  std::size_t vertex_count() const { return positions.size(); }
};

}  // namespace ramify
