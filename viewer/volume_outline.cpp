#include "viewer/volume_outline.h"

#include <algorithm>
#include <array>

#include "common/base/errors.h"
#include "common/volume/solid.h"

namespace ramify {
namespace {

/// Which corners of a grid of cells are inside.
struct CornerGrid {
  CornerGrid(const Solid& solid, const Box& box, double cell)
      : low(box.low), edge(cell), size(Coord(glm::ceil(box.size() / cell)) + 2) {
    low -= Vec3(0.5 * edge);
    is_inside.resize(static_cast<std::size_t>(size.x) * size.y * size.z);
    for (int z = 0; z < size.z; ++z) {
      for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x)
          is_inside[index(x, y, z)] = solid.contains(low + Vec3(x, y, z) * edge);
      }
    }
  }

  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * size.y + y) * size.x + x;
  }

  /// Whether some but not all corners of a cell are inside.
  bool is_crossed(int x, int y, int z) const {
    int inside = 0;
    for (int corner = 0; corner < 8; ++corner) {
      inside += is_inside[index(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2))] ? 1 : 0;
    }
    return inside > 0 && inside < 8;
  }

  Vec3 low;
  double edge;
  Coord size;
  std::vector<char> is_inside;
};

}  // namespace

std::vector<Vec3> surface_points(const Volume& volume, int cells) {
  std::vector<Vec3> points;
  try {
    const Solid solid(volume);
    const Box box = solid.bounds();
    if (box.is_empty()) return points;
    const double edge = std::max({box.size().x, box.size().y, box.size().z, 1e-6}) / cells;
    const CornerGrid grid(solid, box, edge);
    for (int z = 0; z + 1 < grid.size.z; ++z) {
      for (int y = 0; y + 1 < grid.size.y; ++y) {
        for (int x = 0; x + 1 < grid.size.x; ++x) {
          if (grid.is_crossed(x, y, z)) points.push_back(grid.low + (Vec3(x, y, z) + 0.5) * edge);
        }
      }
    }
  } catch (const InputError&) {
    points.clear();  // the check has told
  }
  return points;
}

}  // namespace ramify
