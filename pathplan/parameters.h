// What a path-planned tree is made from.
#pragma once

#include <cstdint>
#include <vector>

#include "common/base/geometry.h"
#include "common/config/field.h"
#include "common/volume/volume.h"

namespace ramify::pathplan {

inline constexpr double kNodesMax = 10e6;  // some gigabytes

enum class EndpointKind { random, shell, region };

/// One level of Xu & Mould 2012, Fig. 4: a graph in a volume, its weights and its endpoints.
struct Level {
  // A trunk and a crown: the first part of a union is the trunk, the others are the crown.
  Volume volume{.shape = Shape::union_of,
                .parts = {{.shape = Shape::cylinder, .radius = 0.25, .height = 5.0},
                          {.shape = Shape::hemisphere, .center = {0.0, 4.5, 0.0}, .radius = 5.5}}};
  int nodes = 30'000;    // K
  double spacing = 0.0;  // d, metres; 0: from `nodes`, else `nodes` follows from it

  int sectors = 8;        // of the Yao graph
  double max_edge = 3.0;  // in spacings

  double weight_exponent = 1.0;  // p in w = length^p * U(lo, hi)
  double weight_low = 0.2;       // lo
  double weight_high = 1.0;      // hi

  EndpointKind endpoints = EndpointKind::region;
  int b = 400;                              // endpoints
  Volume region{.shape = Shape::union_of};  // of region and shell; without parts it is the crown
  double shell_thickness = 0.5;             // d_e, metres

  double zeta = 1.2;  // w = s^zeta

  static const Table& fields();
};

struct Parameters {
  std::uint64_t seed = 1;
  int steps = 0;  // levels to plan; 0: all
  Vec3 root{0.0, 0.0, 0.0};
  double trunk_diameter = 0.5;  // metres, at the root
  double tip_diameter = 0.012;  // metres, the least anywhere
  std::vector<Level> levels = {Level{}};

  static const Table& fields();
};

/// How many levels `steps` asks for.
std::size_t planned_levels(const Parameters& parameters);

/// Where endpoints of the kinds region and shell may lie: `region`, or the crown if that has no parts. The
/// crown is all parts of the level's volume but the first, or a volume that has fewer than two.
Volume endpoint_region(const Level& level);

}  // namespace ramify::pathplan
