// Where the axillary buds of a node point.
#pragma once

#include <cstdint>
#include <span>

#include "growth/parameters.h"

namespace ramify::growth {

/// The tip of an axis: where it points, and a perpendicular to that from which azimuths are counted.
struct Frame {
  Vec3 direction = kUp;  // unit
  Vec3 reference{1, 0, 0};
};

/// An angle as its cosine and sine.
struct Turn {
  explicit Turn(double angle) : cosine(std::cos(angle)), sine(std::sin(angle)) {}

  double cosine;
  double sine;
};

/// The numbers of a step that buds are placed by; radians.
struct BudAngles {
  BudAngles(const TreeParameters& tree, int step);

  double branching;
  double cosine;  // of branching
  double sine;    // likewise
  double divergence;
  double jitter;
  std::vector<Turn> first_turns;  // without jitter, of the buds of an axis's first nodes, node by node
};

/// Axillary buds of a node: 1, 2 or whorl_buds.
std::size_t buds_per_node(const TreeParameters& tree);

/// Sets `directions`, as many as buds_per_node(), to the default directions of the buds on the rank-th node
/// of the axis named `axis_id`, `frame` being its tip at that node. The same for the same seed, axis and
/// rank.
void place_buds(const TreeParameters& tree, std::uint64_t seed, const BudAngles& angles, const Frame& frame,
                std::uint32_t axis_id, std::uint32_t rank, std::span<Vec3f> directions);

}  // namespace ramify::growth
