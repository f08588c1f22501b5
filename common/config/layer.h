// What an engine can show beside its tree: the shadow field, the graph, the endpoints. It leaves the engine
// as layers and only if asked for, so that files, overlays and reports need not know which engine made it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "common/base/geometry.h"

namespace ramify {

struct PointLayer {
  std::vector<Vec3> points;    // metres
  std::vector<double> values;  // one a point, or none
};

struct LineLayer {
  std::vector<Vec3> points;                         // metres
  std::vector<double> point_values;                 // one a point, or none
  std::vector<std::array<std::uint32_t, 2>> lines;  // indices of points
  std::vector<double> values;                       // one a line, or none
};

struct VectorLayer {
  std::vector<Vec3> points;   // metres
  std::vector<Vec3> vectors;  // one a point
};

/// The voxels of a sparse field that are not 0. Voxel (i, j, k) is the cube of edge voxel_size whose centre
/// is voxel_size * (i, j, k).
struct VoxelLayer {
  double voxel_size = 1.0;  // metres
  std::vector<Coord> voxels;
  std::vector<float> values;
};

struct Layer {
  std::string name;  // "shadow", "graph", "endpoints", ...
  std::variant<PointLayer, LineLayer, VectorLayer, VoxelLayer> data;
};

}  // namespace ramify
