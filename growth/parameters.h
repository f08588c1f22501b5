// What growing trees can be told. The letters are those of Palubicki et al. 2009, Self-organizing tree
// models for image synthesis (ACM TOG 28(3)), "P09" in the tables; "SOT" is that paper's public demo, "S4" a
// student report on the same model.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/config/field.h"
#include "common/volume/volume.h"

namespace ramify::growth {

enum class Environment { light, space };
enum class ShadowModel { additive, multiplicative };
enum class Casters { metamers, buds };
enum class OptimalFrom { darkest_free, gradient };
enum class Tie { mean, first };
enum class OptimalPer { metamer, shoot };
enum class Allocation { priority, borchert_honda };
enum class Demand { sum, mean };
enum class SortAfter { mean, total };
enum class Combine { sum, slerp };
enum class Phyllotaxis { spiral, alternate, opposite, whorled, planar_random };
enum class TipBud { both, terminal };
enum class ShedBy { light, vigour };
enum class Towards { direction, horizontal };
enum class PruneSide { inside, outside };

/// A pull on the shoots of some axis orders, in one direction or towards the horizontal.
struct Tropism {
  Schedule weight = 0.1;
  Towards towards = Towards::direction;
  Vec3 direction = kUp;
  int min_order = 0;
  int max_order = 1000;

  static const Table& fields();
};

/// Marker points: the space that trees compete for.
struct MarkerParameters {
  Volume volume{.shape = Shape::sphere, .center = {0.0, 3.0, 0.0}, .radius = 2.7};
  double density = 2000.0;  // a cubic metre

  static const Table& fields();
};

/// Something in the way of shoots.
struct Obstacle {
  Volume volume;
  bool blocks = true;
  double shadow = 0.0;  // in each voxel inside

  static const Table& fields();
};

/// Wood cut away at a step, or every few steps from then on.
struct PruneEvent {
  int step = 1;
  int every = 0;  // steps; 0: once
  PruneSide cut = PruneSide::outside;
  Volume volume;

  static const Table& fields();
};

/// What may differ between trees that grow in one world.
struct TreeParameters {
  // What a bud sees
  Schedule C = 1.0;
  Schedule r = 2.0;  // voxels; space: internodes
  Schedule theta_deg = 90.0;
  Schedule rho = 2.0;  // internodes
  OptimalFrom optimal_from = OptimalFrom::darkest_free;
  Tie tie = Tie::mean;
  Schedule probe_radius = 1.0;  // voxels
  Schedule gradient_max = 1.0;
  OptimalPer v_per = OptimalPer::metamer;

  // Resource
  Allocation allocation = Allocation::priority;
  Schedule alpha0 = 0.0;
  Schedule alpha = 2.0;
  Schedule lambda = 0.5;
  Demand demand = Demand::sum;
  Schedule demand_exponent = 1.0;
  Schedule w_max = 1.0;
  Schedule w_min = 0.006;
  Schedule kappa = 0.5;
  int terminal_first_until = 100'000;
  SortAfter sort_after = SortAfter::mean;

  // Shoots
  Schedule w_default = 1.0;
  Schedule w_optimal = 0.25;  // xi
  std::map<std::string, Tropism> tropism;
  Combine combine = Combine::sum;
  Schedule turn_max = 0.4;  // slerp
  Phyllotaxis phyllotaxis = Phyllotaxis::spiral;
  Schedule divergence_deg = 137.5;  // spiral
  int whorl_buds = 3;               // whorled
  Schedule branching_angle_deg = 60.0;
  Schedule jitter_deg = 0.0;
  TipBud tip_bud = TipBud::both;
  bool sympodial = false;
  Schedule bud_lifespan = 0.0;      // steps; 0: unlimited
  Schedule internode_length = 0.1;  // metres
  Schedule max_metamers = 4.0;      // 0: no cap

  // Shedding
  int shed_after = 0;
  ShedBy shed_by = ShedBy::light;
  Schedule shed_threshold = 0.0;  // 0: never

  static const Table& fields();
};

/// One of several trees: where it stands, and in what it differs from the config's own values.
struct TreePlace : TreeParameters {
  Vec3 position{0.0, 0.0, 0.0};
  std::uint64_t seed = 0;  // 0: the config's, plus how many trees are listed before it

  static const Table& fields();
};

/// The world, and the tree in it if `trees` is empty.
struct Parameters : TreeParameters {
  std::uint64_t seed = 1;
  int steps = 12;
  Environment environment = Environment::light;

  // Light: a voxel q levels below a caster loses a * b^-q.
  ShadowModel shadow = ShadowModel::additive;
  double a = 0.2;
  double b = 2.0;
  int q_max = 4;
  Vec3 sun_direction = kUp;
  double voxel_size = 0.0;  // metres; 0: one internode
  Casters casters = Casters::metamers;
  int leaf_lifespan = 0;  // steps; 0: unlimited

  MarkerParameters markers;  // space

  // Widths
  double pipe_exponent = 2.5;
  double tip_diameter = 0.01;  // metres

  // World
  bool ground = true;
  Schedule ground_y = 0.0;
  std::vector<Obstacle> obstacles;
  std::vector<PruneEvent> prune;
  std::vector<TreePlace> trees;
  int max_internodes = 10'000'000;

  static const Table& fields();

  /// Metres.
  double voxel_edge() const { return voxel_size > 0.0 ? voxel_size : internode_length.at(0); }

  /// The trees to grow, with their seeds; one if none is listed.
  std::vector<TreePlace> planted() const;
};

}  // namespace ramify::growth
