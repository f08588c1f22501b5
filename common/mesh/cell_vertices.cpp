#include "common/mesh/cell_vertices.h"

#include <algorithm>

#include "common/base/errors.h"
#include "common/mesh/leaf_field.h"

namespace ramify {
namespace {

// A voxel outside the surface another part of it is near if the distance there is less than this.
constexpr float kAlone = 0.6f;

/// In voxels from the cell's first corner.
Vec3f amid_crossings(const CellCorners& corners) {
  Vec3f sum(0.0f);
  float crossings = 0.0f;
  for (unsigned low = 0; low < 8; ++low) {
    for (const unsigned bit : {1u, 2u, 4u}) {
      if ((low & bit) != 0 || (corners[low] < 0.0f) == (corners[low | bit] < 0.0f)) continue;
      Vec3f at(low / 4, low / 2 % 2, low % 2);
      at[bit == 4 ? 0 : (bit == 2 ? 1 : 2)] = corners[low] / (corners[low] - corners[low | bit]);
      sum += at;
      crossings += 1.0f;
    }
  }
  return sum / crossings;
}

/// The vertices of a leaf's cells, many at a time.
class VertexPlacer {
 public:
  VertexPlacer(const WoodVoxels& voxels, const FieldItems& items, CellVertices& vertices)
      : voxels_(voxels), items_(items), vertices_(vertices) {}

  /// Of these cells of the leaf; the first vertex is `vertex`.
  void place(std::size_t leaf, const CellMask& cells, const VoxelReader& reader, std::size_t vertex) {
    middle_ = voxels_.middle_of(leaf);
    field_.reset(items_, voxels_.touched.of(leaf), middle_, voxels_.voxel_size);
    const LeafWindow window(leaf, reader);
    count_ = 0;
    cells.for_each([&](int x, int y, int z) {
      // The first voxel stands half a voxel inside the leaf.
      const Vec3f corner = Vec3f(x, y, z) + (0.5f - 0.5f * kLeafSide);
      const Vec3f at = corner + amid_crossings(window.corners(x, y, z));
      corners_[static_cast<std::size_t>(count_)] = corner;
      set(count_++, at);
      if (count_ == kBatch) vertex = finish(vertex);
    });
    finish(vertex);
  }

 private:
  void set(int i, const Vec3f& at) {
    const auto lane = static_cast<std::size_t>(i);
    batch_.x[lane] = at.x;
    batch_.y[lane] = at.y;
    batch_.z[lane] = at.z;
  }

  /// Moves what has gathered onto the surface and writes it. Returns the next vertex.
  std::size_t finish(std::size_t vertex) {
    if (count_ == 0) return vertex;
    batch_.lanes = std::min(kBatch, (count_ + 7) / 8 * 8);
    for (int i = count_; i < batch_.lanes; ++i) set(i, corners_[0]);
    Vec3f low = corners_[0];
    Vec3f high = corners_[0];
    for (int i = 1; i < count_; ++i) {
      low = glm::min(low, corners_[static_cast<std::size_t>(i)]);
      high = glm::max(high, corners_[static_cast<std::size_t>(i)]);
    }
    high += 1.0f;
    field_.focus(0.5f * (low + high), 0.5f * glm::length(high - low) + 1.0f);
    for (int step = 0; step < 2; ++step) {
      field_.slopes(batch_);
      move_to_surface();
    }
    field_.slopes(batch_);
    write(vertex);
    vertex += static_cast<std::size_t>(count_);
    count_ = 0;
    return vertex;
  }

  void move_to_surface() {
    for (int i = 0; i < count_; ++i) {
      const auto lane = static_cast<std::size_t>(i);
      const Vec3f slope(batch_.slope_x[lane], batch_.slope_y[lane], batch_.slope_z[lane]);
      const Vec3f at(batch_.x[lane], batch_.y[lane], batch_.z[lane]);
      const Vec3f moved = at - slope * (batch_.value[lane] / std::max(glm::dot(slope, slope), 0.1f));
      const Vec3f corner = corners_[lane];
      set(i, glm::clamp(moved, corner + kCellMargin, corner + (1.0f - kCellMargin)));
    }
  }

  void write(std::size_t vertex) {
    for (int i = 0; i < count_; ++i) {
      const auto lane = static_cast<std::size_t>(i);
      const Vec3f at(batch_.x[lane], batch_.y[lane], batch_.z[lane]);
      const Vec3f slope(batch_.slope_x[lane], batch_.slope_y[lane], batch_.slope_z[lane]);
      const float steepness = glm::length(slope);
      const Vec3f normal = steepness > 1e-6f ? slope / steepness : Vec3f(kUp);
      vertices_.positions[vertex + lane] = Vec3f(middle_ + Vec3(at) * voxels_.voxel_size);
      vertices_.normals[vertex + lane] = normal;
      vertices_.internodes[vertex + lane] = batch_.internode[lane];
      set(i, at + normal);
    }
    field_.values(batch_);
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(count_); ++lane) {
      vertices_.are_alone[vertex + lane] = batch_.value[lane] >= kAlone;
    }
  }

  const WoodVoxels& voxels_;
  const FieldItems& items_;
  CellVertices& vertices_;
  LeafField field_;
  Vec3 middle_{0.0};
  Batch batch_;
  std::array<Vec3f, kBatch> corners_;  // of the cells
  int count_ = 0;                      // of them
};

/// Each cell that the surface passes has a vertex.
void mark_cells(const WoodVoxels& voxels, CellVertices& vertices) {
  const std::size_t leaf_count = voxels.touched.leaves.size();
  vertices.cells.resize(leaf_count);
  for_each_leaf(voxels, [&](std::size_t i, const VoxelReader& reader) {
    CellMask& cells = vertices.cells[i];
    for_each_crossed_cell(LeafSigns(i, reader), [&](int x, int y, int z) { cells.add(x, y, z); });
  });
  vertices.first_vertex.assign(leaf_count + 1, 0);
  for (std::size_t i = 0; i < leaf_count; ++i)
    vertices.first_vertex[i + 1] = vertices.first_vertex[i] + vertices.cells[i].count();
  if (vertices.first_vertex.back() >= kCellVerticesMax)
    throw RunError("watertight: more than 2^31 vertices (larger voxels)");
}

}  // namespace

std::uint32_t CellVertices::vertex_of(const Coord& cell, const WoodVoxels& voxels,
                                      const VoxelReader& reader) const {
  // All cells that the surface passes are in leaves.
  const std::size_t leaf = *reader.leaf_at(cell);
  const Coord local = cell - voxels.origin_of(leaf);
  return static_cast<std::uint32_t>(first_vertex[leaf] + cells[leaf].count_before(local.x, local.y, local.z));
}

CellVertices place_cell_vertices(const WoodVoxels& voxels, const FieldItems& items) {
  CellVertices vertices;
  mark_cells(voxels, vertices);
  const std::size_t count = vertices.first_vertex.back();
  vertices.positions.resize(count);
  vertices.normals.resize(count);
  vertices.internodes.resize(count);
  vertices.are_alone.resize(count);
  parallel_for(vertices.cells.size(), 16, [&](std::size_t begin, std::size_t end) {
    const VoxelReader reader(voxels);
    VertexPlacer placer(voxels, items, vertices);
    for (std::size_t i = begin; i < end; ++i)
      placer.place(i, vertices.cells[i], reader, vertices.first_vertex[i]);
  });
  return vertices;
}

}  // namespace ramify
