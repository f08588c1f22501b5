// Triangles that close around a solid.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/base/geometry.h"

namespace ramify {

struct ClosedMesh {
  std::vector<Vec3f> points;  // metres
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The faces of an OBJ file, all objects together, polygons cut into triangles. Corners at one place are
/// joined and triangles without area dropped. Which way the faces look does not matter.
/// Throws InputError naming the file: unreadable, no faces, a face with corners that are not there, not
/// closed, which is that some edge has an odd number of triangles.
ClosedMesh read_closed_mesh(const std::filesystem::path& file);

}  // namespace ramify
