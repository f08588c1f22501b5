// Nodes near a place, found by a sieve: in single precision, four at a time, so that few are looked at
// closely that are not near.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/base/geometry.h"
#include "common/base/lanes.h"
#include "pathplan/point_grid.h"

namespace ramify::pathplan {

/// All nodes in the order of a grid's cells, rounded to single precision; a node's place is one in that
/// order. Any number of threads may ask.
class RoundedNodes {
 public:
  /// Looks at the grid, which must outlive it. O(nodes).
  RoundedNodes(std::span<const Vec3> nodes, const PointGrid& grid);

  /// No two nodes are farther from each other, metres.
  double longest() const { return size_; }

  /// The way between the nodes at two places, metres: x, y, z and 0.
  Lanes way(std::uint32_t from, std::uint32_t to) const { return points_[to] - points_[from]; }
  /// What none of its coordinates is off by more than.
  float way_error() const;
  /// What the sum of their squares is not off by more than, where it is at most the square of `reach`.
  float square_error(double reach) const;

 private:
  friend class NearNodes;

  /// The coordinates of the nodes at four places, from `first` on.
  std::array<Lanes, 4> quad(std::size_t first) const {
    return transposed(points_[first], points_[first + 1], points_[first + 2], points_[first + 3]);
  }

  /// A distance that no rounded one exceeds if the true one is at most `reach`.
  float reach_with_rounding(double reach) const;

  const PointGrid& grid_;
  Vec3 center_;                // what they are rounded around
  double size_;                // of their box, in all three directions together, metres
  std::vector<Lanes> points_;  // by place; a few more at the end, near nothing
};

/// Nodes of some cells, to be asked which of them are near. What it returns is valid until it is asked again:
/// places of all nodes that are near, and of few that are not. Some may be there twice.
class NearNodes {
 public:
  explicit NearNodes(const RoundedNodes& nodes) : nodes_(nodes) {}

  /// The nodes of a cell and of its neighbours ahead of it.
  void gather_ahead(std::size_t cell);
  /// Those that are at most `reach` metres from the i-th node of that cell, and ahead of it: their places are
  /// greater than its own.
  std::span<const std::uint32_t> ahead_of(std::size_t i, double reach);

  /// Those in a box of cells, and others, that are at most `reach` metres from a position.
  std::span<const std::uint32_t> among(const PointGrid::Cells& cells, const Vec3& position, double reach);

 private:
  void add_run(std::size_t first, std::size_t size);
  const RoundedNodes& nodes_;
  std::size_t count_ = 0;  // gathered
  std::vector<float> x_, y_, z_;
  std::vector<std::uint32_t> places_;
  std::vector<std::uint32_t> near_;
};

}  // namespace ramify::pathplan
