// The sketch of a surface of revolution: a polyline of points (radius, height) beside an axis.
// XM12 Fig. 14.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/config/sketch.h"

namespace ramify {

/// The solid that a sketch sweeps when it is turned about the axis. The sketch's ends are joined to the axis
/// by flat disks, unless they are one point: then it sweeps a ring. Where the sketch crosses itself, inside
/// is what a way out crosses an odd number of times. Points are given by their distance from the axis and
/// their height. Each question costs O(edges).
class Profile {
 public:
  /// All radii 0 or more; see sketch_problem(). An empty sketch sweeps nothing.
  explicit Profile(const Sketch& sketch);

  /// Distance to the surface, negative inside. Exact.
  double signed_distance(const Vec2& point) const;

  /// The nearest point of the outer surface: all but the flat bottom, which faces down at the lowest height.
  /// The point itself where there is no outer surface.
  Vec2 nearest_outer(const Vec2& point) const;

  /// With those on the axis that close it.
  const Sketch& corners() const { return corners_; }

 private:
  struct Edge {
    Vec2 from;
    Vec2 to;
    bool is_outer;
  };

  Sketch corners_;
  std::vector<Edge> edges_;  // but for those on the axis, which sweep nothing
};

/// What keeps a sketch from being turned, with the number of the point: a negative radius, fewer than two
/// points. Empty if nothing does.
std::string sketch_problem(const Sketch& sketch);

/// A CSV file of two columns, `radius,height`, metres; that header may be missing.
/// Throws InputError naming the file and the line.
Sketch read_sketch(const std::filesystem::path& file);

}  // namespace ramify
