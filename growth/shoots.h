// Shoots: what buds with enough resource grow in a step. Palubicki et al. 2009, 4.3.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "common/base/bulk.h"
#include "growth/barriers.h"
#include "growth/environment_light.h"
#include "growth/plant.h"

namespace ramify::growth {

/// What one bud makes, and where in `Traces` that is.
struct Shoot {
  std::uint32_t bud = 0;
  std::uint32_t planned = 0;  // metamers
  std::uint32_t made = 0;     // fewer where something is in the way
  bool is_terminal = false;   // it continues the axis of its bud; otherwise it founds one
  std::uint32_t axis_id = 0;  // of the axis it founds or, once traced, continues
  double metamer_length = 0.0;
  std::size_t first = 0;      // its start's slot, once traced; those of its metamers follow
  Vec3f end_direction{0.0f};  // of its last metamer
  Vec3f end_reference{0.0f};  // perpendicular to it
};

/// The nodes of some shoots, a slot each: first the node a shoot starts from, then the upper ends of its
/// metamers.
struct Traces {
  std::size_t buds_per_node = 1;
  BulkVector<Vec3> position;
  BulkVector<Coord> voxel;     // light
  BulkVector<Vec3f> axillary;  // default directions of its axillary buds, buds_per_node a slot
};

/// How many metamers the buds will make with this vigour; a number that may be beyond all memory.
double planned_metamers(const MappedVector<double>& vigour, const TreeParameters& tree, int step);

/// Plans a step: one shoot for each bud with v >= 1, the axes of new ones named from plant.axes_founded on.
class ShootPlanner {
 public:
  ShootPlanner(const Plant& plant, const MappedVector<double>& vigour, const TreeParameters& tree, int step);

  /// The next shoots, so many at most; none if there are no more. Those before may be part of the plant by
  /// then.
  std::vector<Shoot> next(std::size_t most);

 private:
  bool pick_buds();

  const Plant& plant_;
  const MappedVector<double>& vigour_;
  double cap_;
  double length_;
  std::vector<std::uint32_t> picked_;  // buds that grow, of those up to next_bud_
  std::size_t next_pick_ = 0;
  std::uint32_t next_bud_ = 0;
  std::uint32_t next_axis_;
};

/// What the shoots of a step are guided by.
struct Guides {
  const Parameters& world;
  const TreeParameters& tree;
  std::uint64_t seed = 1;  // the tree's
  const Barriers& barriers;
  const LightField& light;
  // With environment = space only: Q of each bud, and V where Q > 0. Others go on where they point.
  const MappedVector<double>& exposure;
  const MappedVector<Vec3f>& space;
};

/// Follows each shoot to its end: P09 4.3's weighted sum of default, optimal and tropism direction.
/// O(metamers made), on all threads.
Traces trace_shoots(std::span<Shoot> shoots, const Plant& plant, const Guides& guides, int step);

}  // namespace ramify::growth
