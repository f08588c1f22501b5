#include "pathplan/dart_grid.h"

#include <set>

#include "common/base/rng.h"
#include "tests/catch.h"
#include "tests/pathplan/volumes.h"

using namespace ramify;
using namespace ramify::pathplan;
using namespace ramify::test;

namespace {

/// The cells that rows list, each once.
std::set<std::size_t> listed_cells(const DartGrid& grid) {
  std::set<std::size_t> cells;
  for (const DartGrid::Row& row : grid.rows()) {
    for (std::uint32_t x = row.begin; x < row.end; ++x) {
      CHECK(cells.insert(grid.index_of(grid.point_in(row, x, Vec3(0.5)))).second);
    }
  }
  return cells;
}

}  // namespace

TEST_CASE("dart grid: a box of 3 x 2 x 1 cells has them in rows along x, with a border around") {
  const Box box{Vec3(0.0), Vec3(2.9, 1.9, 0.9)};
  const Solid solid(Volume{.shape = Shape::box, .center = box.center(), .size = box.size()});
  const DartGrid grid(solid, box, 1.0);
  REQUIRE(grid.rows().size() == 2);
  for (const DartGrid::Row& row : grid.rows()) {
    CHECK(row.begin == 0);
    CHECK(row.end == 3);
  }
  CHECK(grid.row_stride() == 5);
  CHECK(grid.layer_stride() == 20);
  CHECK(grid.cell_count() == 60);
  CHECK(grid.index_of({0.5, 0.5, 0.5}) == 26);  // one layer, one row and one cell in
  CHECK(grid.index_of({2.5, 1.5, 0.5}) == 33);
}

TEST_CASE("dart grid: every point of the volume is in a cell that a row lists, and far cells are in none") {
  for (const Place& place : places()) {
    const Solid solid(place.volume);
    for (const double spacing : {0.05, 0.13, 0.6, 2.5}) {
      INFO(place.name << ", spacing " << spacing);
      Box box = solid.bounds();
      box.include(place.root);
      const DartGrid grid(solid, box, spacing);
      const std::set<std::size_t> cells = listed_cells(grid);
      Rng rng = Rng::stream(1, Stream::dart, 0);
      for (int i = 0; i < 20'000; ++i) {
        const Vec3 point = box.low + box.size() * Vec3(rng.uniform(), rng.uniform(), rng.uniform());
        if (solid.contains(point)) REQUIRE(cells.count(grid.index_of(point)) == 1);
      }
      CHECK(cells.count(grid.index_of(place.root)) == 1);
    }
  }
  const Volume far_apart{
      .shape = Shape::union_of,
      .parts = {{.shape = Shape::sphere}, {.shape = Shape::sphere, .center = {20.0, 20.0, 20.0}}}};
  const Solid solid(far_apart);
  const DartGrid grid(solid, solid.bounds(), 0.3);
  CHECK(static_cast<double>(listed_cells(grid).size()) < 0.01 * static_cast<double>(grid.cell_count()));
}

TEST_CASE("dart grid: a dart lies in its own cell, and points nearer than the spacing in cells that touch") {
  const Place place = places()[2];
  const Solid solid(place.volume);
  const DartGrid grid(solid, solid.bounds(), 0.17);
  Rng rng = Rng::stream(1, Stream::dart, 0);
  for (const DartGrid::Row& row : grid.rows()) {
    for (std::uint32_t x = row.begin; x < row.end; ++x) {
      const auto own = static_cast<std::ptrdiff_t>(
          grid.index_of(grid.point_in(row, x, {rng.uniform(), rng.uniform(), rng.uniform()})));
      REQUIRE(own == static_cast<std::ptrdiff_t>((row.z + 1) * grid.layer_stride() +
                                                 (row.y + 1) * grid.row_stride() + x + 1));
      const Vec3 dart = grid.point_in(row, x, {rng.uniform(), rng.uniform(), rng.uniform()});
      const Vec3 near =
          dart + 0.17 / std::sqrt(3.0) * Vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
      const std::ptrdiff_t apart = static_cast<std::ptrdiff_t>(grid.index_of(near)) - own;
      bool is_neighbour = false;
      for (int z = -1; z <= 1; ++z) {
        for (int y = -1; y <= 1; ++y) {
          for (int step = -1; step <= 1; ++step) {
            is_neighbour |= apart == z * static_cast<std::ptrdiff_t>(grid.layer_stride()) +
                                         y * static_cast<std::ptrdiff_t>(grid.row_stride()) + step;
          }
        }
      }
      REQUIRE(is_neighbour);
    }
  }
}
