#include "bench/plain_pathplan.h"

#include <algorithm>
#include <array>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <limits>
#include <nanoflann.hpp>

#include "common/base/rng.h"

namespace ramify::bench {
namespace {

using PlainGraph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property,
                                         boost::property<boost::edge_weight_t, double>>;

/// Positions as nanoflann asks for them.
struct Cloud {
  std::span<const Vec3> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<int>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;  // not known
  }
};

using KdTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, std::uint32_t>;

double weight_of(std::uint32_t a, std::uint32_t b, double length, const pathplan::RandomWeights& weights) {
  Rng rng = Rng::stream(weights.seed, Stream::edge_weight, std::min(a, b), std::max(a, b));
  return length * rng.uniform(weights.low, weights.high);
}

PlainGraph neighbour_graph(std::span<const Vec3> nodes, const pathplan::RandomWeights& weights) {
  const Cloud cloud{nodes};
  const KdTree tree(3, cloud);
  PlainGraph graph(nodes.size());
  std::array<std::uint32_t, kNeighbours + 1> ids;  // the node itself is its own nearest
  std::array<double, kNeighbours + 1> squares;
  for (std::uint32_t node = 0; node < nodes.size(); ++node) {
    const std::size_t count = tree.knnSearch(&nodes[node].x, ids.size(), ids.data(), squares.data());
    for (std::size_t i = 0; i < count; ++i) {
      if (ids[i] == node || boost::edge(node, ids[i], graph).second) continue;
      boost::add_edge(node, ids[i], weight_of(node, ids[i], std::sqrt(squares[i]), weights), graph);
    }
  }
  return graph;
}

PlainPaths paths_in(const PlainGraph& graph) {
  PlainPaths paths{.cost = std::vector<double>(boost::num_vertices(graph)), .edges = boost::num_edges(graph)};
  const auto infinity = std::numeric_limits<double>::infinity();
  boost::dijkstra_shortest_paths(graph, 0, boost::distance_map(paths.cost.data()).distance_inf(infinity));
  return paths;
}

}  // namespace

PlainPaths plain_paths(std::span<const Vec3> nodes, const pathplan::RandomWeights& weights) {
  return paths_in(neighbour_graph(nodes, weights));
}

PlainPaths plain_paths(const pathplan::Graph& graph) {
  PlainGraph plain(graph.nodes.size());
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    boost::add_edge(graph.edges[i][0], graph.edges[i][1], graph.weights[i], plain);
  }
  return paths_in(plain);
}

}  // namespace ramify::bench
