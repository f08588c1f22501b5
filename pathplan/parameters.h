// What a path-planned tree is made from.
#pragma once

#include <cstdint>
#include <vector>

#include "common/base/geometry.h"
#include "common/config/field.h"
#include "common/config/schedule.h"
#include "common/volume/volume.h"

namespace ramify::pathplan {

inline constexpr double kNodesMax = 10e6;  // of all graphs of a level; some gigabytes

enum class SubgraphShape { sphere_portion, cone, inverted_cone, ellipsoid, custom };
enum class Orientation { outwards, fixed, random };
enum class Around { last, all };
enum class Layout { poisson_disc, lattice };
enum class EdgeKind { yao, threshold };
enum class WeightKind { random, incremental, periodic };
enum class EndpointKind { random, shell, region, manual };
enum class LifespanRule { fixed, distribution };
enum class RowBy { level, lifespan };
enum class WidthModel { taper, pipe };
enum class Unreachable { error, warn };

/// An angle that guiding vectors may turn by, and how often it is drawn.
struct TurnChance {
  double probability = 1.0;  // in proportion to the others
  double alpha_deg = 30.0;

  static const Table& fields();
};

/// How guiding vectors turn (Xu and Mould 2015; Xu 2018). Schedules run over the distance from the graph's
/// root: 0 is there, 1 at its farthest node.
struct Guiding {
  Schedule alpha_deg = 10.0;             // incremental: a spacing of way; periodic: a turn
  std::vector<TurnChance> chances = {};  // periodic: in place of alpha_deg
  Schedule d = 10.0;                     // periodic: way between turns, mean edge lengths
  double max_turn_deg = 150.0;           // incremental: in all
  double epsilon = 0.1;                  // keeps the cost along a vector positive

  static const Table& fields();
};

/// More endpoints in the vicinity of the paths found so far.
struct Stage {
  int b = 100;   // endpoints
  int hops = 4;  // how many edges from a path

  static const Table& fields();
};

struct ManualPoint {
  Vec3 position{0.0, 1.0, 0.0};  // metres

  static const Table& fields();
};

/// One level of Xu & Mould 2012, Fig. 4: graphs, their weights and their endpoints.
struct Level {
  // Where the graph of level 1 is. A trunk and a crown: the first part of a union is the trunk, the others
  // are the crown.
  Volume volume{.shape = Shape::union_of,
                .parts = {{.shape = Shape::cylinder, .radius = 0.25, .height = 5.0},
                          {.shape = Shape::hemisphere, .center = {0.0, 4.5, 0.0}, .radius = 5.5}}};
  // Where the graphs of later levels are: about an endpoint, along its v_g.
  SubgraphShape subgraph = SubgraphShape::sphere_portion;
  double alpha_deg = 45.0;  // greatest angle from v_g
  double r = 1.5;           // metres, at level 2
  double a = 0.7;           // of the radius of the level before
  Orientation v_g = Orientation::outwards;
  Vec3 v_g_direction{0.0, -1.0, 0.0};  // fixed
  double turn_deg = 0.0;               // of v_g, upwards; downwards if negative
  Around around = Around::last;        // whose endpoints

  int nodes = 30'000;    // K, of each graph
  double spacing = 0.0;  // d, metres; 0: from `nodes`, else `nodes` follows from it
  Layout layout = Layout::poisson_disc;

  EdgeKind edges = EdgeKind::yao;
  int sectors = 8;        // of the Yao graph
  double max_edge = 3.0;  // in spacings

  WeightKind weights = WeightKind::random;
  double weight_exponent = 1.0;  // p in w = length^p * U(lo, hi)
  double weight_low = 0.2;       // lo
  double weight_high = 1.0;      // hi
  Guiding guiding;

  EndpointKind endpoints = EndpointKind::region;
  int b = 400;                              // endpoints of each graph
  Volume region{.shape = Shape::union_of};  // level 1, region and shell; without parts it is the crown
  double shell_thickness = 0.5;             // d_e, metres
  std::vector<ManualPoint> points = {};     // manual
  std::vector<Stage> stages = {};

  double zeta = 1.2;  // w = s^zeta

  static const Table& fields();
};

/// The crown of level 1 made of spheres, each joined to the trunk by a cone (Xu & Mould 2012, Fig. 12).
struct Refinement {
  int spheres = 0;      // 0: the crown stays as it is
  double radius = 1.5;  // metres

  static const Table& fields();
};

/// How many levels an endpoint has before it.
struct Lifespan {
  LifespanRule rule = LifespanRule::fixed;
  double p_stop = 0.3;          // distribution: that none are left
  RowBy row_by = RowBy::level;  // which level's row a graph takes its values from

  static const Table& fields();
};

/// Branches towards the light live longer and bear more (Xu & Mould 2012, 3.4).
struct Light {
  Vec3 direction{0.0, 1.0, 0.0};  // to the light
  double pull = 0.0;              // of the light on v_g, whose own weight is 1
  int decrement_low = 1;          // of the lifespan, a level: towards the light
  int decrement_high = 1;         // away from it
  double b_low = 1.0;             // endpoints, in b: away from the light
  double b_high = 1.0;            // towards it

  static const Table& fields();
};

/// No node is inside it and no edge goes through it.
struct Obstacle {
  Volume volume;

  static const Table& fields();
};

/// The weights of edges inside it are multiplied.
struct CostVolume {
  Volume volume;
  double factor = 4.0;

  static const Table& fields();
};

struct Parameters {
  std::uint64_t seed = 1;
  int steps = 0;  // levels to plan; 0: all
  Vec3 root{0.0, 0.0, 0.0};
  double trunk_diameter = 0.5;  // metres, at the root
  double tip_diameter = 0.012;  // metres, the least anywhere
  WidthModel widths = WidthModel::taper;
  double pipe_exponent = 2.5;
  std::vector<Level> levels = {Level{}};
  Refinement refine;
  Lifespan lifespan;
  Light light;
  std::vector<Obstacle> obstacles = {};
  std::vector<CostVolume> costs = {};
  std::vector<Level> roots = {};  // levels of a tree below the ground; none: no roots
  Unreachable unreachable = Unreachable::error;

  static const Table& fields();
};

/// How many levels `steps` asks for.
std::size_t planned_levels(const Parameters& parameters);

/// Where endpoints of level 1 of the kinds region and shell may lie: `region`, or the crown if that has no
/// parts. The crown is all parts of the level's volume but the first, or a volume that has fewer than two.
Volume endpoint_region(const Level& level);

}  // namespace ramify::pathplan
