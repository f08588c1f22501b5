// Points in the cells of a uniform grid, so that those near a place are found without looking at the others.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/geometry.h"

namespace ramify::pathplan {

// A good cell, in spacings of Poisson-disc points: about three points each, so that the cells around a point
// hold most of its neighbours.
inline constexpr double kCellSpacings = 2.0;

/// Cells follow each other along x first, then y, then z; the points of each stand together, in the order
/// that they were given in. Any number of threads may ask.
class PointGrid {
 public:
  /// A box of cells, both corners included; at first it holds none.
  struct Cells {
    Coord low{0};
    Coord high{-1};
  };

  /// Cells of about `edge` metres, larger where there would be many more cells than points. O(points).
  PointGrid(std::span<const Vec3> points, double edge);

  std::size_t cell_count() const { return first_.size() - 1; }
  /// The numbers of the points in a cell.
  std::span<const std::uint32_t> ids_in(std::size_t cell) const {
    return run(first_[cell], first_[cell + 1]);
  }

  /// All cells that a box touches; outside the grid, the nearest ones.
  Cells touching(const Box& box) const { return {cell_of(box.low), cell_of(box.high)}; }

  /// Calls visit(run) for runs of points' numbers that together are those in the cells, in their order.
  template <class Visit>
  void for_each_run(const Cells& cells, const Visit& visit) const {
    for (int z = cells.low.z; z <= cells.high.z; ++z) {
      for (int y = cells.low.y; y <= cells.high.y; ++y) {
        // Neighbours along x stand together.
        visit(row(cells.low.x, cells.high.x, y, z));
      }
    }
  }

  /// Calls visit(first, count) for runs of places in order() that together hold the points of a cell, which
  /// come first, and of those neighbours of it, across edges and corners too, that come later in the order.
  template <class Visit>
  void for_each_run_ahead(std::size_t cell, const Visit& visit) const {
    const auto row = static_cast<std::size_t>(count_.x);
    const auto layer = row * static_cast<std::size_t>(count_.y);
    const std::size_t x = cell % row;
    const std::size_t y = cell % layer / row;
    const std::size_t before = x > 0 ? 1 : 0;
    const std::size_t after = x + 1 < row ? 1 : 0;
    const auto visit_cells = [&](std::size_t from, std::size_t to) {
      visit(first_[from], first_[to + 1] - first_[from]);
    };
    visit_cells(cell, cell + after);
    const bool has_next_row = cell % layer + row < layer;
    if (has_next_row) visit_cells(cell + row - before, cell + row + after);
    const std::size_t above = cell + layer;
    if (above >= cell_count()) return;
    if (y > 0) visit_cells(above - row - before, above - row + after);
    visit_cells(above - before, above + after);
    if (has_next_row) visit_cells(above + row - before, above + row + after);
  }

  /// How many cells after a cell its last neighbour comes.
  std::size_t cells_ahead() const {
    return static_cast<std::size_t>(count_.x) * static_cast<std::size_t>(count_.y + 1) + 1;
  }

  /// The most places in order() from a cell's first one to the last one of its neighbours.
  std::size_t places_ahead() const {
    std::size_t most = 0;
    for (std::size_t cell = 0; cell < cell_count(); ++cell) {
      const std::size_t end = std::min(cell + cells_ahead() + 1, cell_count());
      most = std::max(most, std::size_t{first_[end] - first_[cell]});
    }
    return most;
  }

  /// All points' numbers in the order of the cells.
  std::span<const std::uint32_t> order() const { return ids_; }

 private:
  std::span<const std::uint32_t> run(std::uint32_t begin, std::uint32_t end) const {
    return std::span(ids_).subspan(begin, end - begin);
  }

  std::span<const std::uint32_t> row(int x_low, int x_high, int y, int z) const {
    return run(first_[index_of({x_low, y, z})], first_[index_of({x_high, y, z}) + 1]);
  }

  /// The nearest cell for a point outside the grid.
  Coord cell_of(const Vec3& point) const {
    const Vec3 cell = (point - low_) * inverse_edge_;
    return Coord(glm::clamp(cell, Vec3(0.0), Vec3(count_ - 1)));
  }
  std::size_t index_of(const Coord& cell) const {
    return (static_cast<std::size_t>(cell.z) * static_cast<std::size_t>(count_.y) +
            static_cast<std::size_t>(cell.y)) *
               static_cast<std::size_t>(count_.x) +
           static_cast<std::size_t>(cell.x);
  }

  Vec3 low_{0.0};
  double edge_ = 1.0;
  double inverse_edge_ = 1.0;
  Coord count_{1};
  std::vector<std::uint32_t> first_;  // of each cell, in ids_; one more at the end
  std::vector<std::uint32_t> ids_;
};

}  // namespace ramify::pathplan
