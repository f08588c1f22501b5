// The cells that darts are thrown at to spread nodes over a volume: as wide as the spacing, only those that
// may touch the volume.
#pragma once

#include <cstdint>
#include <vector>

#include "common/base/geometry.h"
#include "common/volume/solid.h"

namespace ramify::pathplan {

/// Rows of cells along x. Made once for all graphs in volumes of one shape and size.
class DartGrid {
 public:
  /// Cells of a row that may touch the volume: x from `begin` to `end` - 1.
  struct Row {
    std::uint32_t y;
    std::uint32_t z;
    std::uint32_t begin;
    std::uint32_t end;
  };

  /// `spacing` in metres; `box` holds the solid and what else becomes a node. O(rows + cells outside).
  /// Throws RunError if the solid fills too little of its box for the grid.
  DartGrid(const Solid& solid, const Box& box, double spacing);

  double spacing() const { return spacing_; }
  const std::vector<Row>& rows() const { return rows_; }
  /// Cells with a border one cell wide, so that all cells in a row have neighbours.
  std::size_t cell_count() const { return cell_count_; }
  std::size_t row_stride() const { return row_stride_; }
  std::size_t layer_stride() const { return layer_stride_; }

  /// A point of the cell x of a row; `share` (each 0 to 1) is how far along each edge.
  Vec3 point_in(const Row& row, std::uint32_t x, const Vec3& share) const {
    return low_ + edge_ * (Vec3(x, row.y, row.z) + share);
  }

  /// The number of the cell that holds a point of the box.
  std::size_t index_of(const Vec3& point) const {
    const Coord cell = glm::clamp(Coord((point - low_) * inverse_edge_), Coord(0), count_ - 1) + 1;
    return static_cast<std::size_t>(cell.z) * layer_stride_ + static_cast<std::size_t>(cell.y) * row_stride_ +
           static_cast<std::size_t>(cell.x);
  }

 private:
  double spacing_;
  double edge_;  // of a cell
  double inverse_edge_;
  Vec3 low_;
  Coord count_;  // cells, without the border
  std::size_t row_stride_;
  std::size_t layer_stride_;
  std::size_t cell_count_;
  std::vector<Row> rows_;
};

}  // namespace ramify::pathplan
