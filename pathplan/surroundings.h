// What stands in the world around all graphs of a tree: obstacles, and places that cost more or less.
// L. Xu and D. Mould, A procedural method for irregular tree models, Computers & Graphics 36(8), 2012, 3.4
// and 5.
#pragma once

#include <vector>

#include "common/base/geometry.h"
#include "common/volume/solid.h"
#include "pathplan/parameters.h"

namespace ramify::pathplan {

/// Points are in the world, metres. Any number of threads may ask. Each question costs O(volumes).
class Surroundings {
 public:
  Surroundings() = default;
  explicit Surroundings(const Parameters& parameters);

  bool has_obstacles() const { return !obstacles_.empty(); }
  bool has_costs() const { return !costs_.empty(); }

  bool is_free(const Vec3& point) const;
  /// Whether a straight line meets no obstacle; no wall is jumped, however thin.
  bool is_free(const Vec3& from, const Vec3& to) const;

  /// How much of a volume obstacles take, cubic metres.
  double volume_taken_of(const Volume& volume) const;

  /// What the weight of an edge with this middle is multiplied by: the product over all volumes around it.
  double cost_factor(const Vec3& middle) const;

 private:
  struct Cost {
    Solid place;
    double factor;
  };

  Volume obstacle_union_{.shape = Shape::union_of};
  std::vector<Solid> obstacles_;
  std::vector<Cost> costs_;
};

}  // namespace ramify::pathplan
