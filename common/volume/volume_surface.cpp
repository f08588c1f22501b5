#include "common/volume/volume_surface.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <algorithm>
#include <cmath>

#include "common/volume/placement.h"
#include "common/volume/solid.h"

namespace ramify {
namespace {

// A thin wall is so many voxels thick, as far as kMostVoxels along its longest side allow.
constexpr double kVoxelsAcross = 4.0;
constexpr double kMostVoxels = 512.0;

// Distances are kept so many voxels to either side: what a gradient takes.
constexpr double kBandVoxels = 3.0;

// Voxels of a block that is passed over where the surface is farther.
constexpr int kBlock = 8;

double voxel_size_of(const Vec3& size, int voxels) {
  const double longest = std::max({size.x, size.y, size.z, 1e-9});
  const double thinnest = std::min({size.x, size.y, size.z}) / kVoxelsAcross;
  return std::clamp(thinnest, longest / kMostVoxels, longest / voxels);
}

/// Distances near the surface; elsewhere no more than inside or outside.
openvdb::FloatGrid::Ptr distance_grid(const Solid& solid, double voxel) {
  const auto band = static_cast<float>(kBandVoxels * voxel);
  const openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(band);
  openvdb::FloatGrid::Accessor voxels = grid->getAccessor();
  const Box box = solid.bounds();
  const Coord low = Coord(glm::floor(box.low / voxel)) - 4;
  const Coord high = Coord(glm::ceil(box.high / voxel)) + 4;
  const double reach = 0.5 * kBlock * voxel * std::sqrt(3.0) + band;
  for (int z = low.z; z <= high.z; z += kBlock) {
    for (int y = low.y; y <= high.y; y += kBlock) {
      for (int x = low.x; x <= high.x; x += kBlock) {
        const Vec3 middle = (Vec3(x, y, z) + 0.5 * (kBlock - 1)) * voxel;
        if (std::abs(solid.distance_bound(middle)) > reach) continue;
        for (int index = 0; index < kBlock * kBlock * kBlock; ++index) {
          const Coord at(x + index % kBlock, y + index / kBlock % kBlock, z + index / (kBlock * kBlock));
          const auto distance = static_cast<float>(solid.distance_bound(Vec3(at) * voxel));
          if (std::abs(distance) < band) voxels.setValue({at.x, at.y, at.z}, distance);
        }
      }
    }
  }
  openvdb::tools::signedFloodFill(grid->tree());
  return grid;
}

/// Where the distance grows fastest.
Vec3f normal_at(const Solid& solid, const Vec3& point, double step) {
  Vec3 slope(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 shift(0.0);
    shift[axis] = step;
    slope[axis] = solid.distance_bound(point + shift) - solid.distance_bound(point - shift);
  }
  return Vec3f(normalized_or(slope, kUp, 1e-12));
}

/// Six faces with corners of their own.
VolumeSurface box_surface(const Volume& box) {
  const Placement placement({}, box);
  VolumeSurface surface;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-0.5, 0.5}) {
      Vec3 out(0.0);
      out[axis] = side;
      Vec3 across(0.0);
      across[(axis + 1) % 3] = 0.5;
      const Vec3 up = glm::cross(out, across) * 2.0;
      const auto first = static_cast<std::uint32_t>(surface.positions.size());
      for (const Vec3& corner :
           {out - across - up, out + across - up, out + across + up, out - across + up}) {
        surface.positions.emplace_back(placement.to_world(box.center + corner * box.size));
        surface.normals.emplace_back(placement.normal_to_world(out));
      }
      surface.triangles.push_back({first, first + 1, first + 2});
      surface.triangles.push_back({first, first + 2, first + 3});
    }
  }
  return surface;
}

}  // namespace

VolumeSurface surface_of(const Volume& volume, int voxels) {
  if (volume.shape == Shape::box) return box_surface(volume);
  VolumeSurface surface;
  const Solid solid(volume);
  if (solid.bounds().is_empty()) return surface;
  openvdb::initialize();
  const double voxel = voxel_size_of(solid.bounds().size(), voxels);
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*distance_grid(solid, voxel), points, quads);
  for (const openvdb::Vec3s& point : points) {
    const Vec3 at = Vec3(point.x(), point.y(), point.z()) * voxel;
    surface.positions.emplace_back(at);
    surface.normals.push_back(normal_at(solid, at, 0.5 * voxel));
  }
  for (const openvdb::Vec4I& quad : quads) {
    surface.triangles.push_back({quad[0], quad[1], quad[2]});
    surface.triangles.push_back({quad[0], quad[2], quad[3]});
  }
  return surface;
}

}  // namespace ramify
