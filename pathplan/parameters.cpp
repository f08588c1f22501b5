#include "pathplan/parameters.h"

namespace ramify::pathplan {
namespace {

// Of random factors. A spread of a million leaves all paths on the lightest edges: more changes nothing.
constexpr double kFactorMin = 1e-3;
constexpr double kFactorMax = 1e3;

constexpr double kFar = 1000.0;  // metres
constexpr double kEndpointsMax = 1'000'000;

// A level's rows stand in the order in which a reader meets the model: where its graphs are, what they are
// made of, where their paths lead.

Table place_fields() {
  return make_table<Level>({
      {"volume",
       &Level::volume,
       {.help = "level 1: where the nodes are; the first part of a union is the trunk, the others are the "
                "crown. Later levels, subgraph custom: drawn about the origin along +Y, for r = 1",
        .source = "XM12 3.3.1"}},
      {"subgraph",
       &Level::subgraph,
       {.help = "later levels: shape of a graph about an endpoint; cone has its tip outwards, "
                "inverted_cone at the endpoint",
        .source = "XM12 3.3.2",
        .choices = {"sphere_portion", "cone", "inverted_cone", "ellipsoid", "custom"}}},
      {"alpha_deg",
       &Level::alpha_deg,
       {.max = 180.0,
        .is_above_min = true,
        .unit = "degrees",
        .help = "later levels: greatest angle from v_g, so that a portion of 90 is a half ball; how wide a "
                "cone or ellipsoid is",
        .source = "XM12 Fig. 4, alpha"}},
      {"r",
       &Level::r,
       {.max = kFar,
        .is_above_min = true,
        .unit = "metres",
        .help = "how far a graph of level 2 reaches; one of level i r * a^(i - 2)",
        .source = "XM12 Fig. 4, r"}},
      {"a",
       &Level::a,
       {.max = 4.0,
        .is_above_min = true,
        .help = "size of a graph in that of the level before",
        .source = "XM12 Figs 4, 15"}},
      {"v_g",
       &Level::v_g,
       {.help = "later levels: where a graph is turned to: outwards (from the root of the endpoint's own "
                "graph to the endpoint), v_g_direction, or anywhere",
        .source = "XM12 Fig. 4, step 4B",
        .choices = {"outwards", "fixed", "random"}}},
      {"v_g_direction",
       &Level::v_g_direction,
       {.min = -kFar, .max = kFar, .help = "v_g = fixed: the direction", .source = "XM12 Table 2, e"}},
      {"turn_deg",
       &Level::turn_deg,
       {.min = -180.0,
        .max = 180.0,
        .unit = "degrees",
        .help = "later levels: v_g is turned upwards by this (negative: downwards), no further than the "
                "vertical",
        .source = "XM12 3.3.2, Fig. 16"}},
      {"around",
       &Level::around,
       {.help = "later levels: graphs about the endpoints of the level before, or of all before",
        .source = "XM12 Table 2, f and k",
        .choices = {"last", "all"}}},
  });
}

Table graph_fields() {
  return make_table<Level>({
      {"nodes",
       &Level::nodes,
       {.min = 2,
        .max = kNodesMax,
        .unit = "nodes",
        .help = "nodes of each graph, the root included (K)",
        .source = "XM12 Fig. 4, step 1F"}},
      {"spacing",
       &Level::spacing,
       {.max = kFar,
        .unit = "metres",
        .help = "no two nodes are nearer (d); 0: as `nodes` needs, else the number of nodes follows from it",
        .source = "XM12 Fig. 4, step 1D"}},
      {"layout",
       &Level::layout,
       {.help = "how nodes are spread: at random but for the spacing, or on a cubic lattice, which shows",
        .source = "XM12 Fig. 2",
        .choices = {"poisson_disc", "lattice"}}},
      {"edges",
       &Level::edges,
       {.help = "yao: to the nearest node of each sector; threshold: to every node within max_edge",
        .source = "XM12 3.1, Fig. 22",
        .choices = {"yao", "threshold"}}},
      {"sectors",
       &Level::sectors,
       {.min = 6,
        .max = 14,
        .help = "of the Yao graph, an edge each: 8 (octants), 6 (cones over the faces of a cube) or 14 (over "
                "its faces and corners)",
        .source = "XM12 3.1"}},
      {"max_edge",
       &Level::max_edge,
       {.min = 1.0, .max = 100.0, .unit = "spacings", .help = "greatest length of an edge"}},
      {"weights",
       &Level::weights,
       {.help = "what edges cost: random; or the less the better they follow guiding vectors that turn a "
                "little at every edge (incremental) or by a leap now and then (periodic)",
        .source = "XM12 3.1; XM15; X18",
        .choices = {"random", "incremental", "periodic"}}},
      {"weight_exponent",
       &Level::weight_exponent,
       {.max = 8.0, .help = "random: p in weight = length^p * U(weight_low, weight_high)"}},
      {"weight_low",
       &Level::weight_low,
       {.min = kFactorMin,
        .max = kFactorMax,
        .help = "random: least factor; the wider the spread of factors, the more crooked the branches"}},
      {"weight_high",
       &Level::weight_high,
       {.min = kFactorMin, .max = kFactorMax, .help = "random: greatest factor"}},
      {"guiding", &Level::guiding, {.help = "how guiding vectors turn", .source = "XM15; X18"}},
  });
}

Table path_fields() {
  return make_table<Level>({
      {"endpoints",
       &Level::endpoints,
       {.help = "which nodes may become endpoints: all, those of a shell of the region, those of the region "
                "(later levels: all), or those nearest to `points`",
        .source = "XM12 3.3.1",
        .choices = {"random", "shell", "region", "manual"}}},
      {"b",
       &Level::b,
       {.min = 1,
        .max = kEndpointsMax,
        .unit = "endpoints",
        .help = "number of endpoints of each graph",
        .source = "XM12 Fig. 4, step 2D"}},
      {"region",
       &Level::region,
       {.help = "level 1, of endpoints region and shell; a union without parts, the default, stands for the "
                "crown"}},
      {"shell_thickness",
       &Level::shell_thickness,
       {.max = kFar,
        .is_above_min = true,
        .unit = "metres",
        .help = "how far from the outer surface endpoints of a shell may be (d_e)",
        .source = "XM12 Figs 10, 11"}},
      {"points",
       &Level::points,
       {.help = "level 1, endpoints manual: where they are; nodes where the spacing allows",
        .source = "XM12 Fig. 9"}},
      {"stages",
       &Level::stages,
       {.help = "then more endpoints, near the paths found so far, with paths of their own to these",
        .source = "XM15; X18 Fig. 5"}},
      {"zeta",
       &Level::zeta,
       {.max = 3.0,
        .help = "taper: width = (length walked from the farthest endpoint of the level)^zeta",
        .source = "XM12 3.2"}},
  });
}

}  // namespace

const Table& TurnChance::fields() {
  static const Table table = make_table<TurnChance>({
      {"probability",
       &TurnChance::probability,
       {.max = 1e6, .is_above_min = true, .help = "how often, in proportion to the other rows"}},
      {"alpha_deg",
       &TurnChance::alpha_deg,
       {.min = -180.0, .max = 180.0, .unit = "degrees", .help = "angle of the turn", .source = "X18 V"}},
  });
  return table;
}

const Table& Guiding::fields() {
  static const Table table = make_table<Guiding>({
      {"alpha_deg",
       &Guiding::alpha_deg,
       {.min = -180.0,
        .max = 180.0,
        .unit = "degrees",
        .help = "incremental: turn outwards for each spacing of way; periodic: each turn about a random axis",
        .source = "XM15; X18 III",
        .over = "distance"}},
      {"chances",
       &Guiding::chances,
       {.help = "periodic: angles of which each turn draws one, in place of alpha_deg", .source = "X18 V"}},
      {"d",
       &Guiding::d,
       {.max = 1000.0,
        .is_above_min = true,
        .unit = "mean edge lengths",
        .help = "periodic: way between turns; distances of schedules go from 0 at the root to 1 at the "
                "farthest node",
        .source = "X18 III",
        .over = "distance"}},
      {"max_turn_deg",
       &Guiding::max_turn_deg,
       {.max = 360.0, .unit = "degrees", .help = "incremental: greatest turn in all"}},
      {"epsilon",
       &Guiding::epsilon,
       {.min = 0.01, .max = 10.0, .help = "cost = length * (1 - cosine to the vector + epsilon)"}},
  });
  return table;
}

const Table& Stage::fields() {
  static const Table table = make_table<Stage>({
      {"b",
       &Stage::b,
       {.min = 1, .max = kEndpointsMax, .unit = "endpoints", .help = "number of endpoints more"}},
      {"hops",
       &Stage::hops,
       {.min = 1, .max = 1000, .unit = "edges", .help = "how near to a path they are", .source = "XM15"}},
  });
  return table;
}

const Table& ManualPoint::fields() {
  static const Table table = make_table<ManualPoint>({
      {"position", &ManualPoint::position, {.min = -kFar, .max = kFar, .unit = "metres", .help = "where"}},
  });
  return table;
}

const Table& Level::fields() {
  static const Table table = joined({place_fields(), graph_fields(), path_fields()});
  return table;
}

const Table& Refinement::fields() {
  static const Table table = make_table<Refinement>({
      {"spheres",
       &Refinement::spheres,
       {.max = 100,
        .unit = "spheres",
        .help = "the crown of level 1 becomes so many spheres, each joined to the trunk by a cone and with "
                "as many endpoints; 0: it stays as it is",
        .source = "XM12 Figs 12, 13"}},
      {"radius",
       &Refinement::radius,
       {.max = kFar, .is_above_min = true, .unit = "metres", .help = "of each sphere"}},
  });
  return table;
}

const Table& Lifespan::fields() {
  static const Table table = make_table<Lifespan>({
      {"rule",
       &Lifespan::rule,
       {.help = "an endpoint's lifespan is how many levels may follow it: one less a level, or less by a "
                "random number",
        .source = "XM12 3.2, 3.3.3",
        .choices = {"fixed", "distribution"}}},
      {"p_stop",
       &Lifespan::p_stop,
       {.max = 1.0, .help = "distribution: probability that no level follows", .source = "XM12 3.3.3"}},
      {"row_by",
       &Lifespan::row_by,
       {.help = "a graph takes its values from the row of its level, or from that of its lifespan: the less "
                "is left, the later the row",
        .source = "XM12 3.2",
        .choices = {"level", "lifespan"}}},
  });
  return table;
}

const Table& Light::fields() {
  static const Table table = make_table<Light>({
      {"direction", &Light::direction, {.min = -kFar, .max = kFar, .help = "to the light"}},
      {"pull",
       &Light::pull,
       {.max = 100.0, .help = "weight of the light in v_g, whose own is 1", .source = "XM12 3.4"}},
      {"decrement_low",
       &Light::decrement_low,
       {.min = 1,
        .max = 100,
        .unit = "levels",
        .help = "least decrement of a lifespan: of branches towards the light",
        .source = "XM12 Fig. 19"}},
      {"decrement_high",
       &Light::decrement_high,
       {.min = 1,
        .max = 100,
        .unit = "levels",
        .help = "greatest: of branches away from it",
        .source = "XM12 Fig. 19"}},
      {"b_low",
       &Light::b_low,
       {.max = 100.0,
        .unit = "of b",
        .help = "least number of endpoints: of branches away from the light",
        .source = "XM12 Fig. 18"}},
      {"b_high",
       &Light::b_high,
       {.max = 100.0, .unit = "of b", .help = "greatest: of branches towards it", .source = "XM12 Fig. 18"}},
  });
  return table;
}

const Table& Obstacle::fields() {
  static const Table table = make_table<Obstacle>({
      {"volume", &Obstacle::volume, {.help = "no node is inside it and no edge goes through it"}},
  });
  return table;
}

const Table& CostVolume::fields() {
  static const Table table = make_table<CostVolume>({
      {"volume", &CostVolume::volume, {.help = "where: of an edge its middle counts"}},
      {"factor",
       &CostVolume::factor,
       {.min = kFactorMin,
        .max = kFactorMax,
        .help = "of the weights in there: above 1 branches keep out, below 1 they gather",
        .source = "XM12 5"}},
  });
  return table;
}

const Table& Parameters::fields() {
  static const Table table = make_table<Parameters>({
      {"seed", &Parameters::seed, {.help = "another seed, another tree", .is_top_level = true}},
      {"steps",
       &Parameters::steps,
       {.max = 100, .unit = "levels", .help = "levels to plan; 0: all", .is_top_level = true}},
      {"root",
       &Parameters::root,
       {.min = -kFar,
        .max = kFar,
        .unit = "metres",
        .help = "where the tree starts: in or on the first volume"}},
      {"trunk_diameter",
       &Parameters::trunk_diameter,
       {.max = 100.0, .is_above_min = true, .unit = "metres", .help = "diameter at the root"}},
      {"tip_diameter",
       &Parameters::tip_diameter,
       {.max = 100.0, .is_above_min = true, .unit = "metres", .help = "least diameter anywhere"}},
      {"widths",
       &Parameters::widths,
       {.help = "from the length walked to the tips, or from their number",
        .source = "XM12 3.2; P09 4.4",
        .choices = {"taper", "pipe"}}},
      {"pipe_exponent",
       &Parameters::pipe_exponent,
       {.min = 1.0, .max = 10.0, .help = "pipe: n in d^n = sum of the children's d^n", .source = "P09 4.4"}},
      {"levels",
       &Parameters::levels,
       {.help = "graphs, from the trunk on; a level leaves out what it shares with the one before",
        .source = "XM12 3.2",
        .inherits = true}},
      {"refine", &Parameters::refine, {.help = "the crown of level 1 made of spheres"}},
      {"lifespan", &Parameters::lifespan, {.help = "how many levels may follow an endpoint"}},
      {"light", &Parameters::light, {.help = "branches towards it live longer and bear more"}},
      {"obstacles", &Parameters::obstacles, {.help = "what branches go round", .source = "XM12 3.4"}},
      {"costs", &Parameters::costs, {.help = "where branches would rather be, or not", .source = "XM12 5"}},
      {"roots",
       &Parameters::roots,
       {.help =
            "levels of the roots (keys as in levels), in a volume of their own that holds the tree's root; "
            "none: no roots",
        .source = "XM12 Fig. 24",
        .inherits = true}},
      {"unreachable",
       &Parameters::unreachable,
       {.help = "endpoints that no path leads to: an error, or left out with a warning",
        .source = "XM12 Fig. 22",
        .choices = {"error", "warn"}}},
  });
  return table;
}

std::size_t planned_levels(const Parameters& parameters) {
  return parameters.steps == 0 ? parameters.levels.size() : static_cast<std::size_t>(parameters.steps);
}

Volume endpoint_region(const Level& level) {
  const bool is_given = level.region.shape != Shape::union_of || !level.region.parts.empty();
  if (is_given) return level.region;
  if (level.volume.shape != Shape::union_of || level.volume.parts.size() < 2) return level.volume;
  Volume crown = level.volume;
  crown.parts.erase(crown.parts.begin());
  return crown;
}

}  // namespace ramify::pathplan
