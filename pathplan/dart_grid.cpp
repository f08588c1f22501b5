#include "pathplan/dart_grid.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/base/errors.h"
#include "common/base/parallel.h"

namespace ramify::pathplan {
namespace {

// Cells are this share wider than the spacing, so that rounding cannot put two near points two cells apart.
constexpr double kCellSlack = 1e-9;

constexpr double kCellsMax = 1 << 28;  // four bytes each

// Rows a task.
constexpr std::size_t kRowGrain = 64;

}  // namespace

DartGrid::DartGrid(const Solid& solid, const Box& box, double spacing)
    : spacing_(spacing), edge_(spacing * (1.0 + kCellSlack)), inverse_edge_(1.0 / edge_), low_(box.low) {
  const Vec3 cells = glm::floor(box.size() * inverse_edge_) + 3.0;  // with a border
  if (cells.x * cells.y * cells.z > kCellsMax) {
    throw RunError(
        fmt::format("nodes: {:.3g} cells in the volume's box (at most {:.3g}; fewer nodes, or a "
                    "volume that fills more of its box)",
                    cells.x * cells.y * cells.z, kCellsMax));
  }
  count_ = Coord(cells) - 2;
  row_stride_ = static_cast<std::size_t>(count_.x) + 2;
  layer_stride_ = row_stride_ * (static_cast<std::size_t>(count_.y) + 2);
  cell_count_ = layer_stride_ * (static_cast<std::size_t>(count_.z) + 2);

  const auto height = static_cast<std::size_t>(count_.y);
  rows_.resize(height * static_cast<std::size_t>(count_.z));
  parallel_for(rows_.size(), kRowGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      Row& row = rows_[i];
      row = {static_cast<std::uint32_t>(i % height), static_cast<std::uint32_t>(i / height), 0,
             static_cast<std::uint32_t>(count_.x)};
      const auto is_empty = [&](std::uint32_t x) {
        return solid.is_farther(point_in(row, x, Vec3(0.5)), edge_ * glm::length(Vec3(0.5)));
      };
      while (row.begin < row.end && is_empty(row.begin)) ++row.begin;
      while (row.begin < row.end && is_empty(row.end - 1)) --row.end;
    }
  });
  rows_.erase(std::remove_if(rows_.begin(), rows_.end(), [](const Row& row) { return row.begin == row.end; }),
              rows_.end());
}

}  // namespace ramify::pathplan
