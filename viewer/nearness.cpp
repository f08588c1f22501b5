#include "viewer/nearness.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

namespace ramify {
namespace {

constexpr int kRings = 4;  // of cells, from a node to `reach`

// A grid along whose sides there are more cells is made of larger ones.
constexpr double kMostCells = 128.0;

/// Rings from the nodes' cells to the cells around, as far as kRings.
class RingGrid {
 public:
  RingGrid(std::span<const Vec3> nodes, double reach) {
    Box box;
    for (const Vec3& node : nodes) box.include(node);
    const Vec3 extent = box.size() + 2.0 * reach;
    cell_ = std::max(reach / kRings, std::max({extent.x, extent.y, extent.z}) / kMostCells);
    low_ = box.low - reach - cell_;
    size_ = Coord(glm::ceil(extent / cell_)) + 3;
    rings_.assign(static_cast<std::size_t>(size_.x) * size_.y * size_.z, kRings);
    for (const Vec3& node : nodes) rings_[index(coord(node))] = 0;
    for (std::uint8_t ring = 0; ring < kRings; ++ring) widen(ring);
  }

  /// Of a point anywhere.
  int ring(const Vec3& point) const {
    const Vec3 at = (point - low_) / cell_;
    if (glm::any(glm::lessThan(at, Vec3(0.0))) || glm::any(glm::greaterThanEqual(at, Vec3(size_)))) {
      return kRings;
    }
    return rings_[index(Coord(at))];
  }

 private:
  Coord coord(const Vec3& point) const { return Coord((point - low_) / cell_); }
  std::size_t index(const Coord& at) const {
    return (static_cast<std::size_t>(at.z) * size_.y + at.y) * size_.x + at.x;
  }

  /// Cells beside those of a ring are in the next one. The outermost cells have no node near.
  void widen(std::uint8_t ring) {
    const std::ptrdiff_t row = size_.x;
    const std::ptrdiff_t layer = row * size_.y;
    const auto next = static_cast<std::uint8_t>(ring + 1);
    for (int z = 1; z + 1 < size_.z; ++z) {
      for (int y = 1; y + 1 < size_.y; ++y) {
        for (int x = 1; x + 1 < size_.x; ++x) {
          std::uint8_t* const at = rings_.data() + index({x, y, z});
          if (*at != ring) continue;
          for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, row, layer}) {
            at[step] = std::min(at[step], next);
            at[-step] = std::min(at[-step], next);
          }
        }
      }
    }
  }

  double cell_ = 1.0;
  Vec3 low_{0.0};
  Coord size_{1};
  std::vector<std::uint8_t> rings_;
};

}  // namespace

std::vector<float> nearness(std::span<const Vec3> points, std::span<const Vec3> nodes, double reach) {
  assert(reach > 0.0);
  std::vector<float> result(points.size(), 0.0f);
  if (nodes.empty()) return result;
  const RingGrid grid(nodes, reach);
  std::transform(points.begin(), points.end(), result.begin(),
                 [&](const Vec3& point) { return 1.0f - static_cast<float>(grid.ring(point)) / kRings; });
  return result;
}

}  // namespace ramify
