#include "growth/parameters.h"

namespace ramify::growth {
namespace {

using T = TreeParameters;
using P = Parameters;

// Rows stand in the order in which a reader meets the model: what a bud sees, how resource is shared, what
// a shoot does with it, what is shed.

Table sight_fields() {
  return make_table<T>({
      {"C", &T::C, {.min = 0, .max = 1e3, .help = "light exposure of an unshaded bud", .source = "P09 4.1"}},
      {"r",
       &T::r,
       {.min = 0,
        .max = 20,
        .unit = "voxels; space: internodes",
        .help = "how far a bud looks for light or space",
        .source = "P09 4.1"}},
      {"theta_deg",
       &T::theta_deg,
       {.min = 0,
        .max = 360,
        .unit = "degrees",
        .help = "opening of the cone in which a bud looks",
        .source = "P09 4.1, theta"}},
      {"rho",
       &T::rho,
       {.min = 0,
        .max = 20,
        .unit = "internodes",
        .help = "space: a node takes the markers this near for good",
        .source = "P09 4.1"}},
      {"optimal_from",
       &T::optimal_from,
       {.help = "light: how a bud finds the best direction V: the darkest-free voxels of its cone, or the "
                "slope of the light around it",
        .source = "P09 4.1; SOT",
        .choices = {"darkest-free", "gradient"}}},
      {"tie",
       &T::tie,
       {.help = "darkest-free: which of equally lit voxels a bud grows to: the mean of all, or the first "
                "found (leans)",
        .source = "S4 Figs 4-8",
        .choices = {"mean", "first"}}},
      {"probe_radius",
       &T::probe_radius,
       {.min = 0,
        .max = 20,
        .is_above_min = true,
        .unit = "voxels",
        .help = "gradient: how far from the bud the light is compared",
        .source = "SOT"}},
      {"gradient_max",
       &T::gradient_max,
       {.min = 0,
        .max = 1e3,
        .unit = "1 / voxel",
        .help = "gradient: greatest length of V",
        .source = "SOT"}},
      {"v_per",
       &T::v_per,
       {.help = "light: whether V is looked for at each metamer or once a shoot",
        .source = "P09 4.3; SOT",
        .choices = {"metamer", "shoot"}}},
  });
}

Table resource_fields() {
  return make_table<T>({
      {"allocation",
       &T::allocation,
       {.help = "how a node shares resource",
        .source = "P09 4.2",
        .choices = {"priority", "borchert-honda"}}},
      {"alpha0",
       &T::alpha0,
       {.min = 0,
        .max = 1e6,
        .help = "resource at the root without light: v = alpha0 + alpha * Q",
        .source = "SOT"}},
      {"alpha",
       &T::alpha,
       {.min = 0, .max = 1e3, .help = "resource at the root for a unit of light", .source = "P09 4.2"}},
      {"lambda",
       &T::lambda,
       {.min = 0,
        .max = 1,
        .help = "borchert-honda: share of the main axis; above 0.5 it leads",
        .source = "P09 Eq. 2"}},
      {"demand",
       &T::demand,
       {.help =
            "borchert-honda: what a side counts for: its light, or its size times a power of its mean light",
        .source = "P09 Eq. 2; SOT",
        .choices = {"sum", "mean"}}},
      {"demand_exponent",
       &T::demand_exponent,
       {.min = 0, .max = 10, .help = "demand mean: that power; 1 is the same as sum", .source = "SOT"}},
      {"w_max",
       &T::w_max,
       {.min = 0,
        .max = 1e3,
        .is_above_min = true,
        .help = "priority: weight of the best lit",
        .source = "P09 4.2"}},
      {"w_min",
       &T::w_min,
       {.min = 0,
        .max = 1e3,
        .is_above_min = true,
        .help = "priority: weight of the last",
        .source = "P09 4.2"}},
      {"kappa",
       &T::kappa,
       {.min = 0,
        .max = 1,
        .help = "priority: fraction of the list over which the weight falls",
        .source = "P09 4.2"}},
      {"terminal_first_until",
       &T::terminal_first_until,
       {.min = 0,
        .max = 100'000,
        .unit = "steps",
        .help = "priority: the terminal bud leads its axis until this step",
        .source = "P09 5"}},
      {"sort_after",
       &T::sort_after,
       {.help = "priority: what the list is sorted by after that step",
        .source = "P09 4.2",
        .choices = {"mean", "total"}}},
  });
}

Table shoot_fields() {
  return make_table<T>({
      {"w_default",
       &T::w_default,
       {.min = 0, .max = 10, .help = "weight of a shoot's default direction", .source = "P09 4.3"}},
      {"w_optimal",
       &T::w_optimal,
       {.min = 0, .max = 10, .help = "weight of the best direction V", .source = "P09 4.3, xi"}},
      {"tropism", &T::tropism, {.help = "named pulls on shoots"}},
      {"combine",
       &T::combine,
       {.help = "a metamer's direction: the weighted sum, or turned from its default towards the weighted V "
                "and tropisms",
        .source = "P09 4.3; SOT",
        .choices = {"sum", "slerp"}}},
      {"turn_max",
       &T::turn_max,
       {.min = 0,
        .max = 1,
        .help = "slerp: greatest part of the angle that a metamer turns",
        .source = "SOT"}},
      {"phyllotaxis",
       &T::phyllotaxis,
       {.help = "where axillary buds stand: every divergence_deg, every 180 degrees, in pairs, in whorls, or "
                "left and right in a plane",
        .source = "P09 3; S4",
        .choices = {"spiral", "alternate", "opposite", "whorled", "planar-random"}}},
      {"divergence_deg",
       &T::divergence_deg,
       {.min = 0,
        .max = 360,
        .unit = "degrees",
        .help = "spiral: azimuth from one bud to the next",
        .source = "P09 3"}},
      {"whorl_buds", &T::whorl_buds, {.min = 2, .max = 16, .help = "whorled: buds a node"}},
      {"branching_angle_deg",
       &T::branching_angle_deg,
       {.min = 0,
        .max = 180,
        .unit = "degrees",
        .help = "between a bud and the axis that bears it",
        .source = "P09 3"}},
      {"jitter_deg",
       &T::jitter_deg,
       {.min = 0,
        .max = 180,
        .unit = "degrees",
        .help = "most that a bud's azimuth and branching angle stray, each way"}},
      {"tip_bud",
       &T::tip_bud,
       {.help = "buds of a shoot's last node: terminal and axillary, or the terminal alone",
        .source = "P09 3: both; S4: terminal",
        .choices = {"both", "terminal"}}},
      {"sympodial",
       &T::sympodial,
       {.help = "whether a terminal bud dies after its shoot and the axillary bud at the tip goes on"}},
      {"bud_lifespan",
       &T::bud_lifespan,
       {.min = 0,
        .max = 1e4,
        .unit = "steps",
        .help = "a bud that has rested so long dies; 0: never",
        .source = "P09 3"}},
      {"internode_length",
       &T::internode_length,
       {.min = 1e-4,
        .max = 100,
        .unit = "metres",
        .help = "of an internode of vigour 1",
        .source = "P09 4.3"}},
      {"max_metamers",
       &T::max_metamers,
       {.min = 0,
        .max = 1e4,
        .help = "most metamers of a shoot, what is above is lost; 0: no cap",
        .source = "SOT"}},
  });
}

Table shedding_fields() {
  return make_table<T>({
      {"shed_after",
       &T::shed_after,
       {.min = 0,
        .max = 100'000,
        .unit = "steps",
        .help = "nothing is shed up to this step",
        .source = "P09 4.4"}},
      {"shed_by",
       &T::shed_by,
       {.help = "what is shed: whole axes with little light an internode, or any part with little resource "
                "an internode",
        .source = "P09 4.4; SOT",
        .choices = {"light", "vigour"}}},
      {"shed_threshold",
       &T::shed_threshold,
       {.min = 0,
        .max = 1e3,
        .help = "how little is too little; 0: nothing is shed",
        .source = "P09 4.4, after Takenaka 1994"}},
  });
}

Table light_fields() {
  return make_table<P>({
      {"environment",
       &P::environment,
       {.help = "what buds compete for: light in a shadow field, or space held by marker points",
        .source = "P09 4.1",
        .choices = {"light", "space"}}},
      {"shadow",
       &P::shadow,
       {.help = "light: casters take away a * b^-q each, or the share that SOT's field has",
        .source = "P09 4.1; SOT",
        .choices = {"additive", "multiplicative"}}},
      {"a",
       &P::a,
       {.min = 0,
        .max = 10,
        .is_above_min = true,
        .help = "shadow of a caster in its own voxel",
        .source = "P09 4.1"}},
      {"b",
       &P::b,
       {.min = 1,
        .max = 100,
        .is_above_min = true,
        .help = "how fast shadow fades: a * b^-q on the q-th level below",
        .source = "P09 4.1"}},
      {"q_max",
       &P::q_max,
       {.min = 0, .max = 32, .unit = "voxels", .help = "depth of the penumbra", .source = "P09 4.1"}},
      {"sun_direction",
       &P::sun_direction,
       {.min = -1e3,
        .max = 1e3,
        .help = "towards the light, at least 20 degrees high; shadows fall away from it"}},
      {"voxel_size",
       &P::voxel_size,
       {.min = 0,
        .max = 100,
        .unit = "metres",
        .help = "edge of a shadow voxel; 0: as long as an internode",
        .source = "P09 4.1"}},
      {"casters",
       &P::casters,
       {.help = "what casts shadow",
        .source = "P09 4.1: metamers; S4: buds",
        .choices = {"metamers", "buds"}}},
      {"leaf_lifespan",
       &P::leaf_lifespan,
       {.min = 0,
        .max = 10'000,
        .unit = "steps",
        .help = "a metamer casts shadow so long; 0: as long as it lives"}},
      {"markers",
       &P::markers,
       {.help = "space: the points that nodes take and buds grow towards", .source = "P09 4.1"}},
  });
}

Table world_fields() {
  return make_table<P>({
      {"pipe_exponent",
       &P::pipe_exponent,
       {.min = 1, .max = 10, .help = "n in d^n = sum of d^n over the children", .source = "P09 4.4"}},
      {"tip_diameter",
       &P::tip_diameter,
       {.min = 0,
        .max = 10,
        .is_above_min = true,
        .unit = "metres",
        .help = "of an internode that never bore another",
        .source = "P09 4.4"}},
      {"ground", &P::ground, {.help = "whether nothing grows below ground_y"}},
      {"ground_y", &P::ground_y, {.min = -1e4, .max = 1e4, .unit = "metres", .help = "height of the ground"}},
      {"obstacles", &P::obstacles, {.help = "what stands in the way, or in the light"}},
      {"prune", &P::prune, {.help = "when and where wood is cut away"}},
      {"trees",
       &P::trees,
       {.help = "several trees that compete; each has what the config says but for its own keys",
        .inherits_owner = true}},
      {"max_internodes",
       &P::max_internodes,
       {.min = 1, .max = 100'000'000, .help = "a step that would make more living ones is not taken"}},
  });
}

}  // namespace

const Table& Tropism::fields() {
  static const Table table = make_table<Tropism>({
      {"weight",
       &Tropism::weight,
       {.min = -10, .max = 10, .help = "strength, beside w_default", .source = "P09 4.3, eta"}},
      {"towards",
       &Tropism::towards,
       {.help = "along `direction`, or to the horizontal (plagiotropism)",
        .choices = {"direction", "horizontal"}}},
      {"direction",
       &Tropism::direction,
       {.min = -1e3, .max = 1e3, .help = "where to; any length but 0", .source = "P09 4.3, T"}},
      {"min_order",
       &Tropism::min_order,
       {.min = 0, .max = 1000, .help = "lowest axis order it acts on; 0 is the trunk"}},
      {"max_order", &Tropism::max_order, {.min = 0, .max = 1000, .help = "highest axis order it acts on"}},
  });
  return table;
}

const Table& MarkerParameters::fields() {
  using M = MarkerParameters;
  static const Table table = make_table<M>({
      {"volume", &M::volume, {.help = "where the markers are", .source = "P09 4.1"}},
      {"density",
       &M::density,
       {.min = 0,
        .max = 1e9,
        .is_above_min = true,
        .unit = "1 / cubic metre",
        .help = "how many there are",
        .source = "P09 4.1"}},
  });
  return table;
}

const Table& Obstacle::fields() {
  static const Table table = make_table<Obstacle>({
      {"volume", &Obstacle::volume, {.help = "its shape"}},
      {"blocks", &Obstacle::blocks, {.help = "whether no shoot grows into it"}},
      {"shadow", &Obstacle::shadow, {.min = 0, .max = 1e3, .help = "light: shadow in each voxel inside it"}},
  });
  return table;
}

const Table& PruneEvent::fields() {
  using E = PruneEvent;
  static const Table table = make_table<E>({
      {"step", &E::step, {.min = 1, .max = 10'000, .unit = "steps", .help = "after which step"}},
      {"every",
       &E::every,
       {.min = 0, .max = 10'000, .unit = "steps", .help = "again after so many; 0: once"}},
      {"cut",
       &E::cut,
       {.help = "which side of the volume's surface goes, with all that grows from it",
        .choices = {"inside", "outside"}}},
      {"volume", &E::volume, {.help = "the shape that is cut to, or out"}},
  });
  return table;
}

const Table& TreeParameters::fields() {
  static const Table table = joined({sight_fields(), resource_fields(), shoot_fields(), shedding_fields()});
  return table;
}

const Table& TreePlace::fields() {
  static const Table own = make_table<TreePlace>({
      {"position", &TreePlace::position, {.min = -1e4, .max = 1e4, .unit = "metres", .help = "of its root"}},
      {"seed", &TreePlace::seed, {.help = "of its own; 0: the config's, plus 1 for each tree before it"}},
  });
  static const Table table = joined({own, rows_of_base<TreePlace, TreeParameters>()});
  return table;
}

const Table& Parameters::fields() {
  static const Table own = make_table<P>({
      {"seed", &P::seed, {.help = "the same seed makes the same tree", .is_top_level = true}},
      {"steps",
       &P::steps,
       {.min = 1, .max = 10'000, .help = "steps of growth, about years", .is_top_level = true}},
  });
  static const Table table =
      joined({own, light_fields(), rows_of_base<Parameters, TreeParameters>(), world_fields()});
  return table;
}

std::vector<TreePlace> Parameters::planted() const {
  std::vector<TreePlace> places = trees;
  if (places.empty()) static_cast<TreeParameters&>(places.emplace_back()) = *this;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].seed == 0) places[i].seed = seed + i;
  }
  return places;
}

}  // namespace ramify::growth
