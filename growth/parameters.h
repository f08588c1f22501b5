// What a growing tree can be told. The letters are those of Palubicki et al. 2009, Self-organizing tree
// models for image synthesis (ACM TOG 28(3)), "P09" in the tables.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "common/config/field.h"

namespace ramify::growth {

enum class Allocation { priority, borchert_honda };
enum class SortAfter { mean, total };
enum class Casters { metamers, buds };
enum class Tie { mean, first };
enum class Phyllotaxis { spiral, planar_random };
enum class TipBud { both, terminal };

/// A pull on all shoots, in one direction.
struct Tropism {
  Schedule weight = 0.1;
  Vec3 direction = kUp;

  static const Table& fields();
};

struct Parameters {
  std::uint64_t seed = 1;
  int steps = 12;

  // Light: a voxel q levels below a caster loses a * b^-q.
  double a = 0.2;
  double b = 2.0;
  int q_max = 4;
  Schedule C = 1.0;
  double voxel_size = 0.0;  // metres; 0: one internode
  Casters casters = Casters::metamers;

  // Best direction of growth: the darkest-free voxels of a cone.
  Schedule r = 2.0;  // voxels
  Schedule theta_deg = 90.0;
  Tie tie = Tie::mean;

  // Resource
  Allocation allocation = Allocation::priority;
  Schedule alpha0 = 0.0;
  Schedule alpha = 2.0;
  Schedule lambda = 0.5;
  Schedule w_max = 1.0;
  Schedule w_min = 0.006;
  Schedule kappa = 0.5;
  int terminal_first_until = 100'000;
  SortAfter sort_after = SortAfter::mean;

  // Shoots
  Schedule w_default = 1.0;
  Schedule w_optimal = 0.25;  // xi
  std::map<std::string, Tropism> tropism;
  Phyllotaxis phyllotaxis = Phyllotaxis::spiral;
  Schedule branching_angle_deg = 60.0;
  TipBud tip_bud = TipBud::both;
  Schedule internode_length = 0.1;  // metres
  Schedule max_metamers = 4.0;      // 0: no cap

  // Shedding
  int shed_after = 0;
  Schedule shed_threshold = 0.0;  // 0: never

  // Widths
  double pipe_exponent = 2.5;
  double tip_diameter = 0.01;  // metres

  // World
  bool ground = true;
  double ground_y = 0.0;
  int max_internodes = 10'000'000;

  static const Table& fields();

  /// Metres.
  double voxel_edge() const { return voxel_size > 0.0 ? voxel_size : internode_length.at(0); }
};

}  // namespace ramify::growth
