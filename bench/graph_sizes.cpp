#include "bench/graph_sizes.h"

#include <fmt/format.h>

#include "bench/plain_pathplan.h"
#include "bench/planned_trees.h"

namespace ramify::bench {
namespace {

using namespace pathplan;

// Of the threshold, in spacings.
constexpr double kPrecision = 1e-3;

bool is_connected(const Mushroom& mushroom, double threshold) {
  Graph graph;
  graph.nodes = mushroom.nodes.position;
  graph.edges = mushroom.edges_within(threshold);
  graph.weights.assign(graph.edges.size(), 1.0f);
  link_nodes(graph);
  return component_count(graph) == 1;
}

/// The least that connects all nodes, in spacings: no two are nearer than one.
double connecting_threshold(const Mushroom& mushroom) {
  double low = 1.0;
  double high = 3.0;
  while (high - low > kPrecision) {
    const double middle = 0.5 * (low + high);
    (is_connected(mushroom, middle * mushroom.nodes.spacing) ? high : low) = middle;
  }
  return high;
}

}  // namespace

GraphSizes graph_sizes(int nodes) {
  const Mushroom mushroom(nodes);
  const auto a_node = [&](std::size_t edges) { return static_cast<double>(edges) / nodes; };
  const auto yao = [&](int sectors) {
    return a_node(mushroom.graph(mushroom.nodes.position, sectors).edges.size());
  };
  GraphSizes sizes{.nodes = nodes, .cube_faces = yao(6), .octants = yao(8), .faces_and_corners = yao(14)};
  sizes.neighbours = a_node(plain_paths(mushroom.nodes.position, kWeights).edges);
  sizes.threshold_spacings = connecting_threshold(mushroom);
  sizes.threshold = a_node(mushroom.edges_within(sizes.threshold_spacings * mushroom.nodes.spacing).size());
  return sizes;
}

void print(const GraphSizes& sizes) {
  constexpr const char* layout = "{:<44} {:>12} {:>16}  {}\n";
  const auto add = [&](const std::string& graph, double edges, const char* published) {
    fmt::print(layout, graph, fmt::format("{:.2f}", edges), fmt::format("{:.2f}", edges / sizes.octants),
               published);
  };
  fmt::print("\nEdges a node, {} nodes in a trunk and a crown\n", sizes.nodes);
  fmt::print(layout, "graph", "edges a node", "by 8 sectors'", "Xu & Mould 2012");
  add("Yao, 6 sectors", sizes.cube_faces, "about six; its figure, in the plane, has six sectors");
  add("Yao, 8 sectors", sizes.octants, "");
  add("Yao, 14 sectors", sizes.faces_and_corners, "");
  add(fmt::format("{} nearest neighbours", kNeighbours), sizes.neighbours, "");
  add(fmt::format("threshold of {:.3f} spacings, just connected", sizes.threshold_spacings), sizes.threshold,
      "nearly double, tuned until trees looked good");
}

}  // namespace ramify::bench
