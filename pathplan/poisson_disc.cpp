#include "pathplan/poisson_disc.h"

#include <algorithm>
#include <array>
#include <optional>

#include "common/base/parallel.h"
#include "common/base/rng.h"
#include "common/volume/volume.h"
#include "pathplan/point_grid.h"

namespace ramify::pathplan {
namespace {

// In units of (V/K)^(1/3). Random packing saturates near 0.9 and takes many passes from 0.85 on.
constexpr double kSpacingShare = 0.75;

// At kSpacingShare three passes do; a volume whose nodes still do not fit after this many needs less spacing.
constexpr int kPassesMax = 16;
constexpr double kSpacingShrink = 0.95;

// Darts that are kept in memory at once, and rows of them a task.
constexpr std::size_t kDartsAtOnce = 100'000;
constexpr std::size_t kRowGrain = 16;

// So few nodes are in the cache in whatever order they stand.
constexpr std::size_t kSortedFrom = 512;

constexpr std::uint32_t kNone = 0xffffffff;

/// Darts thrown at a grid whose cells are as wide as the spacing: what is too near stands in the 27 cells
/// around a dart.
class Board {
 public:
  Board(const DartGrid& grid, const Domain& domain, std::uint64_t seed)
      : grid_(grid),
        domain_(domain),
        seed_(seed),
        square_(grid.spacing() * grid.spacing()),
        newest_(grid.cell_count(), kNone) {}

  /// One dart a cell, rows in order: some rows are thrown on all threads and what is too near older points
  /// sorted out; what is left is tried one after the other.
  void throw_darts(int pass, const std::stop_token& stop) {
    const std::vector<DartGrid::Row>& rows = grid_.rows();
    const std::size_t rows_at_once = std::max<std::size_t>(1, kDartsAtOnce / grid_.row_stride());
    std::vector<std::vector<Vec3>> darts(std::min(rows.size(), rows_at_once));
    for (std::size_t first = 0; first < rows.size() && !stop.stop_requested(); first += rows_at_once) {
      const std::size_t count = std::min(rows_at_once, rows.size() - first);
      parallel_for(count, kRowGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) throw_row(rows[first + i], pass, darts[i]);
      });
      for (std::size_t i = 0; i < count; ++i) {
        for (const Vec3& dart : darts[i]) add_if_free(dart);
      }
    }
  }

  void add_if_free(const Vec3& point) {
    if (!is_free(point)) return;
    std::uint32_t& newest = newest_[grid_.index_of(point)];
    before_.push_back(newest);
    newest = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
  }

  const std::vector<Vec3>& points() const { return points_; }
  std::vector<Vec3> take_points() { return std::move(points_); }

 private:
  /// Leaves the darts inside the domain that are far enough from all points.
  void throw_row(const DartGrid::Row& row, int pass, std::vector<Vec3>& darts) const {
    darts.clear();
    Rng rng = Rng::stream(seed_, Stream::dart, (std::uint64_t{row.z} << 32) + row.y,
                          static_cast<std::uint64_t>(pass));
    for (std::uint32_t x = row.begin; x < row.end; ++x) {
      const double dx = rng.uniform();
      const double dy = rng.uniform();
      const double dz = rng.uniform();
      const Vec3 dart = grid_.point_in(row, x, {dx, dy, dz});
      if (domain_.contains(dart) && is_free(dart)) darts.push_back(dart);
    }
  }

  bool is_near(std::uint32_t point, const Vec3& dart) const {
    const Vec3 apart = points_[point] - dart;
    return glm::dot(apart, apart) < square_;
  }

  bool is_free(const Vec3& dart) const {
    // What is too near is most often in the dart's own cell.
    const std::size_t own = grid_.index_of(dart);
    if (newest_[own] != kNone && is_near(newest_[own], dart)) return false;

    // Whether a cell is empty cannot be foreseen: the points are listed without a branch, then looked at.
    const std::size_t row_stride = grid_.row_stride();
    const std::size_t layer_stride = grid_.layer_stride();
    std::array<std::uint32_t, 27> near;
    std::size_t count = 0;
    for (std::size_t layer = own - layer_stride; layer <= own + layer_stride; layer += layer_stride) {
      for (std::size_t row = layer - row_stride; row <= layer + row_stride; row += row_stride) {
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

  const DartGrid& grid_;
  const Domain& domain_;
  std::uint64_t seed_;
  double square_;                      // of the spacing
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
std::vector<Vec3> sorted_nodes(std::vector<Vec3> points, double spacing) {
  if (points.size() < kSortedFrom) return points;
  std::vector<Vec3> sorted;
  sorted.reserve(points.size());
  sorted.push_back(points.front());
  const PointGrid grid(points, kCellSpacings * spacing);
  for (const std::uint32_t id : grid.order()) {
    if (id != 0) sorted.push_back(points[id]);
  }
  return sorted;
}

Box box_around(const Solid& solid, std::span<const Vec3> roots) {
  Box box = solid.bounds();
  for (const Vec3& root : roots) box.include(root);
  return box;
}

}  // namespace

double wanted_nodes(const Scatter& scatter, double cubic_metres) {
  if (scatter.spacing == 0.0) return scatter.nodes;
  return std::max(2.0, std::round(cubic_metres * std::pow(kSpacingShare / scatter.spacing, 3)));
}

double wanted_spacing(const Scatter& scatter, double cubic_metres) {
  return scatter.spacing > 0.0 ? scatter.spacing : kSpacingShare * std::cbrt(cubic_metres / scatter.nodes);
}

PoissonDisc::PoissonDisc(const Solid& solid, const Scatter& scatter, double cubic_metres,
                         std::span<const Vec3> roots)
    : wanted_(static_cast<std::size_t>(wanted_nodes(scatter, cubic_metres))),
      is_spacing_given_(scatter.spacing > 0.0),
      box_(box_around(solid, roots)),
      grid_(solid, box_, wanted_spacing(scatter, cubic_metres)) {}

Nodes PoissonDisc::scatter(const Domain& domain, std::span<const Vec3> roots, bool may_shrink,
                           std::uint64_t seed, const std::stop_token& stop,
                           const std::function<void(double done, double total)>& progress) const {
  std::optional<DartGrid> narrower;
  while (true) {
    const DartGrid& grid = narrower ? *narrower : grid_;
    Board board(grid, domain, seed);
    for (const Vec3& root : roots) board.add_if_free(root);
    std::size_t settled = board.points().size();  // nodes before the last pass
    for (int pass = 0; pass < kPassesMax && board.points().size() < wanted_; ++pass) {
      settled = board.points().size();
      if (progress) progress(static_cast<double>(settled), static_cast<double>(wanted_));
      if (stop.stop_requested()) break;
      board.throw_darts(pass, stop);
    }
    const bool is_final = is_spacing_given_ || !may_shrink || stop.stop_requested();
    if (board.points().size() >= wanted_ || is_final) {
      std::vector<Vec3> points = board.take_points();
      drop_surplus(points, settled, wanted_, seed);
      return {sorted_nodes(std::move(points), grid.spacing()), grid.spacing()};
    }
    narrower.emplace(domain.solid, box_, kSpacingShrink * grid.spacing());
  }
}

Nodes scatter_nodes(const Volume& volume, const Vec3& root, const Scatter& scatter, std::uint64_t seed) {
  const Solid solid(volume);
  const Surroundings open;
  const std::array<Vec3, 1> roots = {root};
  return PoissonDisc(solid, scatter, volume_of(volume), roots).scatter({solid, open}, roots, true, seed);
}

}  // namespace ramify::pathplan
