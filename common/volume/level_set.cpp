#include "common/volume/level_set.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <deque>
#include <limits>
#include <mutex>

#include "common/base/errors.h"

namespace ramify {
namespace {

// The interpolation reads voxels on both sides of the surface and one farther out.
constexpr float kBandVoxels = 3.0f;

// Voxels along the longest side: enough for a third of a percent of it. A flat mesh gets more, so that it is
// kVoxelsAcross thick.
constexpr double kVoxelsAlong = 128.0;
constexpr double kVoxelsAcross = 8.0;
constexpr double kFinestChosen = 512.0;

// More than that take minutes and gigabytes.
constexpr double kMostVoxelsAlong = 1000.0;

// Of the field that knows the depth everywhere inside: its cost grows with the cube.
constexpr double kDepthVoxelsAlong = 32.0;

// Level sets kept for the next who asks.
constexpr std::size_t kKept = 8;

double longest(const Vec3& size) {
  return std::max({size.x, size.y, size.z});
}

double chosen_voxel_size(const Vec3& size) {
  const double thinnest = std::min({size.x, size.y, size.z}) / kVoxelsAcross;
  return std::clamp(thinnest, longest(size) / kFinestChosen, longest(size) / kVoxelsAlong);
}

/// Distances within so many voxels outside and inside the mesh.
openvdb::FloatGrid::ConstPtr distances(const ClosedMesh& mesh, double voxel_size, float outside,
                                       float inside) {
  std::vector<openvdb::Vec3s> points;
  for (const Vec3f& p : mesh.points) points.emplace_back(p.x, p.y, p.z);
  std::vector<openvdb::Vec3I> triangles;
  for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel_size);
  return openvdb::tools::meshToSignedDistanceField<openvdb::FloatGrid>(*transform, points, triangles, {},
                                                                       outside, inside);
}

double sample(const openvdb::FloatGrid& grid, const Vec3& point, double voxel_size) {
  // An accessor that is not registered with the tree, so that threads do not meet.
  const auto voxels = grid.getConstUnsafeAccessor();
  const openvdb::Vec3R place(point.x / voxel_size, point.y / voxel_size, point.z / voxel_size);
  return openvdb::tools::BoxSampler::sample(voxels, place);
}

}  // namespace

struct LevelSet::Grids {
  openvdb::FloatGrid::ConstPtr band;
  openvdb::FloatGrid::ConstPtr depth;
  double depth_voxel_size;
};

LevelSet::LevelSet(const ClosedMesh& mesh, double voxel_size) : voxel_size_(voxel_size) {
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) bounds_.include(Vec3(mesh.points[corner]));
  }
  const Vec3 size = bounds_.size();
  if (voxel_size_ == 0.0) voxel_size_ = chosen_voxel_size(size);
  if (longest(size) > kMostVoxelsAlong * voxel_size_) {
    throw InputError(fmt::format("{} m long, more than {} voxels of {} m (larger voxels)", longest(size),
                                 kMostVoxelsAlong, voxel_size_));
  }
  openvdb::initialize();
  auto grids = std::make_unique<Grids>();
  grids->band = distances(mesh, voxel_size_, kBandVoxels, kBandVoxels);
  grids->depth_voxel_size = std::max(voxel_size_, longest(size) / kDepthVoxelsAlong);
  grids->depth = distances(mesh, grids->depth_voxel_size, kBandVoxels, std::numeric_limits<float>::max());
  grids_ = std::move(grids);
}

LevelSet::~LevelSet() = default;

double LevelSet::signed_distance(const Vec3& point) const {
  return sample(*grids_->band, point, voxel_size_);
}

double LevelSet::depth(const Vec3& point) const {
  const double near = -signed_distance(point);
  if (near < 0.99 * kBandVoxels * voxel_size_) return std::max(near, 0.0);
  return std::max(near, -sample(*grids_->depth, point, grids_->depth_voxel_size));
}

std::shared_ptr<const LevelSet> level_set_of(const std::filesystem::path& file, double voxel_size) {
  struct Kept {
    std::filesystem::path file;
    double voxel_size;
    std::filesystem::file_time_type written;
    std::uintmax_t bytes;
    std::shared_ptr<const LevelSet> level_set;
  };
  static std::mutex mutex;
  static std::deque<Kept> kept;

  std::error_code ignored;  // a missing file is named by whoever reads it
  const auto written = std::filesystem::last_write_time(file, ignored);
  const auto bytes = std::filesystem::file_size(file, ignored);
  const auto absolute = std::filesystem::absolute(file, ignored);
  {
    const std::lock_guard lock(mutex);
    for (const Kept& one : kept) {
      const bool is_same = one.file == absolute && one.voxel_size == voxel_size && one.written == written &&
                           one.bytes == bytes;
      if (is_same) return one.level_set;
    }
  }
  // Not under the lock: the thread that waits for OpenVDB's tasks may take one of ours that asks here, too.
  std::shared_ptr<const LevelSet> made;
  const ClosedMesh mesh = read_closed_mesh(file);
  try {
    made = std::make_shared<LevelSet>(mesh, voxel_size);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
  const std::lock_guard lock(mutex);
  kept.push_back({absolute, voxel_size, written, bytes, made});
  if (kept.size() > kKept) kept.pop_front();
  return made;
}

}  // namespace ramify
