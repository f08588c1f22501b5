#include "pathplan/point_grid.h"

#include <numeric>

namespace ramify::pathplan {
namespace {

// Few points in a large box, as in a thin tilted trunk, must not need memory for the box.
constexpr double kMaxCellsPerPoint = 8.0;

}  // namespace

PointGrid::PointGrid(std::span<const Vec3> points, double edge) {
  Box box;
  for (const Vec3& point : points) box.include(point);
  if (points.empty()) box.include(Vec3(0.0));
  low_ = box.low;

  // An infinite edge makes one cell.
  const double cells_max = kMaxCellsPerPoint * static_cast<double>(points.size() + 1);
  Vec3 count = glm::floor(box.size() / edge) + 1.0;
  while (count.x * count.y * count.z > cells_max) {
    edge *= 1.25;
    count = glm::floor(box.size() / edge) + 1.0;
  }
  edge_ = edge;
  inverse_edge_ = 1.0 / edge;
  count_ = Coord(count);

  // A counting sort, from the last point to the first: the cells' ends come down to their beginnings, and the
  // points of a cell keep their order.
  std::vector<std::uint32_t> cell_of_point(points.size());
  first_.assign(index_of(count_ - 1) + 2, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    cell_of_point[i] = static_cast<std::uint32_t>(index_of(cell_of(points[i])));
    ++first_[cell_of_point[i]];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  ids_.resize(points.size());
  for (std::size_t i = points.size(); i-- > 0;) {
    ids_[--first_[cell_of_point[i]]] = static_cast<std::uint32_t>(i);
  }
}

}  // namespace ramify::pathplan
