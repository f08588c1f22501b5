// A triangle mesh with the attributes that files and the renderer use, and the materials it is made of.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/base/bulk.h"
#include "common/base/geometry.h"
#include "common/base/image.h"

namespace ramify {

/// What a surface looks like, in the terms of glTF's metallic-roughness model: nothing of a tree is metal.
struct Material {
  std::string name;           // "bark", "leaf"
  Vec3f color{1.0f};          // linear RGB; multiplied by image and vertex colours where there are some
  float roughness = 0.9f;     // 0 mirror, 1 dull
  Image image;                // empty: the colour alone
  Image normal_map;           // empty: none; tangent space, x along +u, y along +v, z outwards
  bool is_cutout = false;     // where the image's alpha is below one half there is nothing
  bool is_overlay = false;    // lies on other surfaces, seen as far as the vertex colours' alpha says
  bool is_two_sided = false;  // both sides are seen; else the surface is closed and only its outside is
};

/// A run of triangles that share a material.
struct MaterialRange {
  std::size_t material = 0;  // index into Mesh::materials
  std::size_t first_triangle = 0;
  std::size_t triangle_count = 0;
};

/// Three vertices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

struct Mesh {
  BulkVector<Vec3f> positions;  // metres
  BulkVector<Vec3f> normals;    // unit length, one a vertex
  BulkVector<Vec2f> uvs;  // one a vertex; v = 0 is an image's lower edge. Bark: u around the branch, v along
  BulkVector<glm::vec4> tangents;  // along +u, unit length; w = 1 or -1: bitangent = w * cross(normal, xyz).
                                   // One for each vertex of the wood, then for each of its overlay; or empty
  BulkVector<std::array<std::uint8_t, 4>> colors;  // sRGB and alpha, one a vertex; empty: none
  BulkVector<std::uint32_t> internodes;            // the skeleton node that each vertex belongs to
  BulkVector<Triangle> triangles;
  std::vector<MaterialRange>
      ranges;  // in order, covering all triangles; overlays, whose vertices are their own, come last
  std::vector<Material> materials;
  std::vector<std::string> warnings;  // of the mesher, one line each

  std::size_t vertex_count() const { return positions.size(); }
  const Material& material(const MaterialRange& range) const { return materials[range.material]; }
};

/// What of a mesh is no overlay: its first vertices and triangles.
struct SolidPart {
  std::size_t vertex_count = 0;
  std::size_t triangle_count = 0;
};

/// For formats that know no transparency, and wherever surfaces count once. O(triangles of overlays).
SolidPart solid_part(const Mesh& mesh);

/// Without anything in it, but with all its memory, for a mesh of about the same size.
inline Mesh emptied(Mesh mesh) {
  mesh.positions.clear();
  mesh.normals.clear();
  mesh.uvs.clear();
  mesh.tangents.clear();
  mesh.colors.clear();
  mesh.internodes.clear();
  mesh.triangles.clear();
  mesh.ranges.clear();
  mesh.materials.clear();
  mesh.warnings.clear();
  return mesh;
}

}  // namespace ramify
