#include "pathplan/parameters.h"

namespace ramify::pathplan {
namespace {

// Of random factors. A spread of a million leaves all paths on the lightest edges: more changes nothing.
constexpr double kFactorMin = 1e-3;
constexpr double kFactorMax = 1e3;

}  // namespace

const Table& Level::fields() {
  static const Table table = make_table<Level>({
      {"volume",
       &Level::volume,
       {.help = "where the nodes are; the first part of a union is the trunk, the others are the crown",
        .source = "XM12 3.3.1"}},
      {"nodes",
       &Level::nodes,
       {.min = 2,
        .max = kNodesMax,
        .unit = "nodes",
        .help = "nodes of the graph, the root included (K)",
        .source = "XM12 Fig. 4, step 1F"}},
      {"spacing",
       &Level::spacing,
       {.max = 1000.0,
        .unit = "metres",
        .help = "no two nodes are nearer (d); 0: as `nodes` needs, else the number of nodes follows from it",
        .source = "XM12 Fig. 4, step 1D"}},
      {"sectors",
       &Level::sectors,
       {.min = 6,
        .max = 8,
        .help = "of the Yao graph, an edge each: 8 (octants) or 6 (cones over the faces of a cube)",
        .source = "XM12 3.1"}},
      {"max_edge",
       &Level::max_edge,
       {.min = 1.0, .max = 100.0, .unit = "spacings", .help = "greatest length of an edge"}},
      {"weight_exponent",
       &Level::weight_exponent,
       {.max = 8.0, .help = "p in weight = length^p * U(weight_low, weight_high)"}},
      {"weight_low",
       &Level::weight_low,
       {.min = kFactorMin,
        .max = kFactorMax,
        .help = "least random factor; the wider the spread of factors, the more crooked the branches"}},
      {"weight_high",
       &Level::weight_high,
       {.min = kFactorMin, .max = kFactorMax, .help = "greatest random factor"}},
      {"endpoints",
       &Level::endpoints,
       {.help =
            "which nodes may become endpoints: all, those of a shell of the region, or those of the region",
        .source = "XM12 3.3.1",
        .choices = {"random", "shell", "region"}}},
      {"b",
       &Level::b,
       {.min = 1,
        .max = 1'000'000,
        .unit = "endpoints",
        .help = "number of endpoints",
        .source = "XM12 Fig. 4, step 2D"}},
      {"region",
       &Level::region,
       {.help = "of endpoints region and shell; a union without parts, the default, stands for the crown"}},
      {"shell_thickness",
       &Level::shell_thickness,
       {.max = 1000.0,
        .is_above_min = true,
        .unit = "metres",
        .help = "how far from the region's outer surface endpoints of a shell may be (d_e)",
        .source = "XM12 Figs 10, 11"}},
      {"zeta",
       &Level::zeta,
       {.max = 3.0,
        .help = "taper: width = (length walked from the farthest endpoint)^zeta",
        .source = "XM12 3.2"}},
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
       {.min = -1000.0,
        .max = 1000.0,
        .unit = "metres",
        .help = "where the tree starts: in or on the first volume"}},
      {"trunk_diameter",
       &Parameters::trunk_diameter,
       {.max = 100.0, .is_above_min = true, .unit = "metres", .help = "diameter at the root"}},
      {"tip_diameter",
       &Parameters::tip_diameter,
       {.max = 100.0, .is_above_min = true, .unit = "metres", .help = "least diameter anywhere"}},
      {"levels",
       &Parameters::levels,
       {.help = "graphs, from the trunk on; a level leaves out what it shares with the one before",
        .source = "XM12 3.2",
        .inherits = true}},
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
