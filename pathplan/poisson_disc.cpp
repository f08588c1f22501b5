#include "pathplan/poisson_disc.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/base/errors.h"
#include "common/base/parallel.h"
#include "common/base/rng.h"
#include "pathplan/point_grid.h"

namespace ramify::pathplan {
namespace {

// In units of (V/K)^(1/3). Random packing saturates near 0.9 and takes many passes from 0.85 on.
constexpr double kSpacingShare = 0.75;

// At kSpacingShare three passes do; a volume whose nodes still do not fit after this many needs less spacing.
constexpr int kPassesMax = 16;
constexpr double kSpacingShrink = 0.95;

// Cells are this share wider than the spacing, so that rounding cannot put two near points two cells apart.
constexpr double kCellSlack = 1e-9;

constexpr double kCellsMax = 1 << 28;  // four bytes each

// Cells along x that are passed over together where the volume is far.
constexpr std::size_t kStretch = 4;
const Vec3 kStretchMiddle(0.5 * kStretch, 0.5, 0.5);

// Cells whose darts are kept in memory at once, and rows of them a task.
constexpr std::size_t kCellsAtOnce = 100'000;
constexpr std::size_t kRowGrain = 16;

constexpr std::uint32_t kNone = 0xffffffff;

/// Darts thrown at a grid whose cells are as wide as the spacing: what is too near stands in the 27 cells
/// around a dart.
class Board {
 public:
  Board(const Box& box, double spacing)
      : spacing_(spacing), edge_(spacing * (1.0 + kCellSlack)), inverse_edge_(1.0 / edge_), low_(box.low) {
    const Vec3 cells = glm::floor(box.size() * inverse_edge_) + 3.0;  // a border, so that all have neighbours
    if (cells.x * cells.y * cells.z > kCellsMax) {
      throw RunError(
          fmt::format("nodes: {:.3g} cells in the volume's box (at most {:.3g}; fewer nodes, or a "
                      "volume that fills more of its box)",
                      cells.x * cells.y * cells.z, kCellsMax));
    }
    count_ = Coord(cells) - 2;
    row_ = static_cast<std::size_t>(count_.x) + 2;
    layer_ = row_ * (static_cast<std::size_t>(count_.y) + 2);
    newest_.assign(layer_ * (static_cast<std::size_t>(count_.z) + 2), kNone);
  }

  /// One dart a cell, cells in order: rows of them are thrown on all threads and what is too near older
  /// points sorted out; what is left is tried one after the other.
  void throw_darts(const Solid& solid, std::uint64_t seed, std::uint64_t pass, const std::stop_token& stop) {
    const std::size_t rows = static_cast<std::size_t>(count_.y) * static_cast<std::size_t>(count_.z);
    const std::size_t rows_at_once =
        std::max<std::size_t>(1, kCellsAtOnce / static_cast<std::size_t>(count_.x));
    std::vector<std::vector<Vec3>> darts(std::min(rows, rows_at_once));
    for (std::size_t first = 0; first < rows && !stop.stop_requested(); first += rows_at_once) {
      const std::size_t count = std::min(rows_at_once, rows - first);
      parallel_for(count, kRowGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) throw_row(solid, seed, pass, first + i, darts[i]);
      });
      for (std::size_t i = 0; i < count; ++i) {
        for (const Vec3& dart : darts[i]) {
          if (is_free(dart)) add(dart);
        }
      }
    }
  }

  void add(const Vec3& point) {
    std::uint32_t& newest = newest_[index_of(point)];
    before_.push_back(newest);
    newest = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
  }

  const std::vector<Vec3>& points() const { return points_; }
  std::vector<Vec3> take_points() { return std::move(points_); }

 private:
  /// Leaves the darts inside the solid that are far enough from all points.
  void throw_row(const Solid& solid, std::uint64_t seed, std::uint64_t pass, std::size_t row,
                 std::vector<Vec3>& darts) const {
    darts.clear();
    const auto width = static_cast<std::size_t>(count_.x);
    const auto height = static_cast<std::size_t>(count_.y);
    for (std::size_t x = 0; x < width; ++x) {
      const Vec3 cell(x, row % height, row / height);
      const bool is_empty = x % kStretch == 0 && solid.is_farther(low_ + edge_ * (cell + kStretchMiddle),
                                                                  edge_ * glm::length(kStretchMiddle));
      if (is_empty) {
        x += kStretch - 1;
        continue;
      }
      Rng rng = Rng::stream(seed, Stream::dart, row * width + x, pass);
      const double dx = rng.uniform();
      const double dy = rng.uniform();
      const double dz = rng.uniform();
      const Vec3 dart = low_ + edge_ * (cell + Vec3(dx, dy, dz));
      if (solid.contains(dart) && is_free(dart)) darts.push_back(dart);
    }
  }

  std::size_t index_of(const Vec3& point) const {
    const Coord cell = glm::clamp(Coord((point - low_) * inverse_edge_), Coord(0), count_ - 1) + 1;
    return static_cast<std::size_t>(cell.z) * layer_ + static_cast<std::size_t>(cell.y) * row_ +
           static_cast<std::size_t>(cell.x);
  }

  bool is_near(std::uint32_t point, const Vec3& dart) const {
    const Vec3 apart = points_[point] - dart;
    return glm::dot(apart, apart) < spacing_ * spacing_;
  }

  bool is_free(const Vec3& dart) const {
    // What is too near is most often in the dart's own cell.
    const std::size_t own = index_of(dart);
    if (newest_[own] != kNone && is_near(newest_[own], dart)) return false;

    // Whether a cell is empty cannot be foreseen: the points are listed without a branch, then looked at.
    std::array<std::uint32_t, 27> near;
    std::size_t count = 0;
    for (std::size_t layer = own - layer_; layer <= own + layer_; layer += layer_) {
      for (std::size_t row = layer - row_; row <= layer + row_; row += row_) {
        for (std::size_t cell = row - 1; cell <= row + 1; ++cell) {
          near[count] = newest_[cell];
          count += newest_[cell] != kNone ? 1 : 0;
        }
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      for (std::uint32_t point = near[i]; point != kNone; point = before_[point]) {
        if (is_near(point, dart)) return false;
      }
    }
    return true;
  }

  double spacing_;
  double edge_;  // of a cell
  double inverse_edge_;
  Vec3 low_;
  Coord count_;  // cells, without the border
  std::size_t row_ = 0;
  std::size_t layer_ = 0;
  std::vector<std::uint32_t> newest_;  // of each cell, the point that came last
  std::vector<std::uint32_t> before_;  // of each point, the one before it in its cell
  std::vector<Vec3> points_;
};

/// Removes random points from those after the first `settled`, until `wanted` are left.
void drop_surplus(std::vector<Vec3>& points, std::size_t settled, std::size_t wanted, std::uint64_t seed) {
  Rng rng = Rng::stream(seed, Stream::surplus, 0);
  while (points.size() > wanted) {
    points[settled + rng.below(points.size() - settled)] = points.back();
    points.pop_back();
  }
}

/// Root first, the others in the order of the cells.
std::vector<Vec3> sorted_nodes(const std::vector<Vec3>& points, double spacing) {
  std::vector<Vec3> sorted;
  sorted.reserve(points.size());
  sorted.push_back(points.front());
  const PointGrid grid(points, kCellSpacings * spacing);
  for (const std::uint32_t id : grid.order()) {
    if (id != 0) sorted.push_back(points[id]);
  }
  return sorted;
}

}  // namespace

double wanted_nodes(const Scatter& scatter, double cubic_metres) {
  if (scatter.spacing == 0.0) return scatter.nodes;
  return std::max(2.0, std::round(cubic_metres * std::pow(kSpacingShare / scatter.spacing, 3)));
}

Nodes scatter_nodes(const Volume& volume, const Vec3& root, const Scatter& scatter, std::stop_token stop,
                    const std::function<void(double done, double total)>& progress) {
  const Solid solid(volume);
  Box box = solid.bounds();
  box.include(root);
  const double cubic_metres = volume_of(volume);
  const auto wanted = static_cast<std::size_t>(wanted_nodes(scatter, cubic_metres));
  const bool may_shrink = scatter.spacing == 0.0;
  double spacing = may_shrink ? kSpacingShare * std::cbrt(cubic_metres / scatter.nodes) : scatter.spacing;

  while (true) {
    Board board(box, spacing);
    board.add(root);
    std::size_t settled = 1;  // nodes before the last pass
    for (int pass = 0; pass < kPassesMax && board.points().size() < wanted; ++pass) {
      settled = board.points().size();
      if (progress) progress(static_cast<double>(settled), static_cast<double>(wanted));
      if (stop.stop_requested()) break;
      board.throw_darts(solid, scatter.seed, static_cast<std::uint64_t>(pass), stop);
    }
    if (board.points().size() >= wanted || !may_shrink || stop.stop_requested()) {
      std::vector<Vec3> points = board.take_points();
      drop_surplus(points, settled, wanted, scatter.seed);
      return {sorted_nodes(points, spacing), spacing};
    }
    spacing *= kSpacingShrink;
  }
}

}  // namespace ramify::pathplan
