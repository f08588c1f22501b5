// The growing tree as flat arrays. Nodes and axes stand in the order of their creation, so a parent is before
// its children: a loop forward is acropetal, a loop backward basipetal.
#pragma once

#include <cstdint>
#include <vector>

#include "common/base/geometry.h"
#include "common/skeleton/skeleton.h"
#include "growth/parameters.h"

namespace ramify::growth {

/// A chain of internodes made by one bud and its successors; axis 0 is the trunk.
struct Axis {
  std::uint32_t base = 0;        // the node it grows from, on its parent axis (the trunk: the root)
  std::uint32_t first = 0;       // its first own node; of the trunk the root
  std::uint32_t node_count = 0;  // its own nodes so far; of the trunk the root too
  std::uint32_t birth_step = 0;
  std::uint16_t order = 0;
  bool is_shed = false;
  Vec3 direction = kUp;     // of its last internode; of its bud before there is one
  Vec3 reference{1, 0, 0};  // perpendicular to `direction`, carried along without twist: azimuth 0
};

struct Bud {
  std::uint32_t node = 0;  // where it stands
  std::uint32_t axis = 0;  // the axis it continues (terminal) or stands on (axillary)
  bool is_terminal = false;
  Vec3 direction = kUp;  // default direction of its first metamer; a terminal bud has its axis's
};

struct Plant {
  // Nodes; 0 is the root
  std::vector<Vec3> position;
  std::vector<std::uint32_t> parent;
  std::vector<std::uint32_t> axis;
  std::vector<std::uint32_t> birth_step;
  std::vector<std::uint32_t> shed_step;  // kAlive while it lives

  std::vector<Axis> axes;
  std::vector<Bud> buds;  // the living

  std::size_t node_count() const { return position.size(); }
  std::size_t internode_count() const { return position.size() - 1; }  // shed ones too
};

/// The state of step 0: a terminal bud at the root, pointing up.
Plant seedling(const Parameters& parameters);

/// The sums that the models share resource by, basipetal: at each node over its buds and all beyond them.
struct LightSums {
  std::vector<double> main;               // over the continuation of the node's axis
  std::vector<double> lateral;            // over its axillary buds and lateral axes
  std::vector<std::uint32_t> buds;        // how many buds
  std::vector<std::uint32_t> internodes;  // how many living internodes, the node's own included

  double total(std::size_t node) const { return main[node] + lateral[node]; }
};

/// `light` has one entry a bud. O(nodes).
void sum_light(const Plant& plant, const std::vector<double>& light, LightSums& sums);

/// The plant's history as a skeleton, with widths by the pipe model. `light` and `vigour` have one entry a
/// bud; both are summed over each internode's subtree.
Skeleton to_skeleton(const Plant& plant, const Parameters& parameters, const std::vector<double>& light,
                     const std::vector<double>& vigour);

}  // namespace ramify::growth
