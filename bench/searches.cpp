#include "bench/searches.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "bench/plain_pathplan.h"
#include "bench/planned_trees.h"
#include "common/base/errors.h"
#include "common/base/parallel.h"
#include "common/base/rng.h"
#include "pathplan/guiding.h"
#include "pathplan/point_grid.h"
#include "pathplan/shortest_paths.h"
#include "pathplan/weights.h"

namespace ramify::bench {
namespace {

using namespace pathplan;

constexpr int kRepetitions = 3;
constexpr int kSearches = 100;  // of some milliseconds: what else runs on the machine would decide of fewer
constexpr int kFigureNodes = 33'000;
constexpr int kManyNodes = 1'000'000;

// Both add the same numbers in the same order, but for paths of equal cost.
constexpr double kTolerance = 1e-12;

constexpr const char* kRandom = "search/random";
constexpr const char* kIncremental = "search/incremental";
constexpr const char* kPeriodic = "search/periodic";

const std::vector<std::uint32_t> kRoot = {0};

/// In what order the nodes stand before anything is measured.
enum class Order { cells, random };

std::string costs_name(bool is_plain, int nodes, Order order) {
  return fmt::format("costs/{}/{}/{}", nodes, order == Order::cells ? "cells" : "random",
                     is_plain ? "plain" : "ours");
}

/// The root stays in its place.
std::vector<Vec3> shuffled(std::vector<Vec3> nodes) {
  Rng rng = Rng::stream(1, Stream::marker, 0);
  for (std::size_t i = nodes.size() - 1; i > 1; --i) std::swap(nodes[i], nodes[1 + rng.below(i)]);
  return nodes;
}

/// Places of the nodes in the order of cells, the root first: what the engine does with its nodes.
std::vector<std::uint32_t> cell_order(std::span<const Vec3> nodes, double spacing) {
  const PointGrid grid(nodes, kCellSpacings * spacing);
  std::vector<std::uint32_t> order = {0};
  order.reserve(nodes.size());
  for (const std::uint32_t id : grid.order()) {
    if (id != 0) order.push_back(id);
  }
  return order;
}

/// From positions in the order of cells to costs, by node.
std::vector<double> sorted_costs(const Mushroom& mushroom, std::vector<Vec3> nodes) {
  return shortest_paths(mushroom.graph(std::move(nodes)), kRoot).cost;
}

/// From positions in any order.
std::vector<double> unsorted_costs(const Mushroom& mushroom, std::span<const Vec3> nodes) {
  const std::vector<std::uint32_t> order = cell_order(nodes, mushroom.nodes.spacing);
  std::vector<Vec3> sorted(nodes.size());
  for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = nodes[order[i]];
  const std::vector<double> in_order = sorted_costs(mushroom, std::move(sorted));
  std::vector<double> costs(nodes.size());
  for (std::size_t i = 0; i < order.size(); ++i) costs[order[i]] = in_order[i];
  return costs;
}

/// What is measured on; made when first asked for.
class Subjects {
 public:
  const Mushroom& mushroom(int nodes) {
    std::unique_ptr<Mushroom>& mushroom = mushrooms_[nodes];
    if (!mushroom) mushroom = std::make_unique<Mushroom>(nodes);
    return *mushroom;
  }

  std::vector<Vec3> nodes(int count, Order order) {
    const std::vector<Vec3>& sorted = mushroom(count).nodes.position;
    return order == Order::cells ? sorted : shuffled(sorted);
  }

  const Graph& graph() {
    if (graph_.nodes.empty()) {
      const Mushroom& place = mushroom(kFigureNodes);
      graph_ = place.graph(place.nodes.position);
    }
    return graph_;
  }

 private:
  std::map<int, std::unique_ptr<Mushroom>> mushrooms_;
  Graph graph_;
};

/// Times work that returns one cost a node, all of which must be finite.
template <class Work>
Outcome timed_costs(const Work& work) {
  std::vector<double> costs;
  const Outcome outcome = timed([&] { costs = work(); });
  for (const double cost : costs) {
    if (!std::isfinite(cost)) throw RunError("a node is not reached");
  }
  return outcome;
}

Outcome find_costs(Subjects& subjects, bool is_plain, int count, Order order) {
  const Mushroom& mushroom = subjects.mushroom(count);
  const std::vector<Vec3> nodes = subjects.nodes(count, order);
  if (is_plain) return timed_costs([&] { return plain_paths(nodes, kWeights).cost; });
  if (order == Order::random) return timed_costs([&] { return unsorted_costs(mushroom, nodes); });
  return timed_costs([&] { return sorted_costs(mushroom, nodes); });
}

/// The quickest of many searches.
template <class Search>
Outcome quickest(const Search& search) {
  Outcome best = search();
  for (int i = 1; i < kSearches; ++i) {
    const Outcome outcome = search();
    if (outcome.seconds < best.seconds) best = outcome;
  }
  return best;
}

Outcome search_random(Subjects& subjects) {
  const Graph& graph = subjects.graph();
  return quickest([&] { return timed_costs([&] { return shortest_paths(graph, kRoot).cost; }); });
}

Outcome search_guided(Subjects& subjects, WeightKind kind) {
  Graph graph = subjects.graph();
  assign_lengths(graph);
  link_nodes(graph);
  Level level;
  level.weights = kind;
  const double spacing = subjects.mushroom(kFigureNodes).nodes.spacing;
  return quickest([&] {
    GuidedSearch search(graph, level, spacing, kUp, 1);  // weights are not timed in the other search either
    return timed_costs([&] { return search.paths_from(kRoot).cost; });
  });
}

}  // namespace

void register_searches(Results& results, bool is_quick) {
  const auto subjects = std::make_shared<Subjects>();
  const auto add = [&](const std::string& name, int repetitions, auto work) {
    register_work(results, name, repetitions, [subjects, work] {
      const ThreadLimit limit(1);
      return work(*subjects);
    });
  };
  for (const int count : {kFigureNodes, kManyNodes}) {
    if (is_quick && count == kManyNodes) continue;
    for (const Order order : {Order::cells, Order::random}) {
      for (const bool is_plain : {false, true}) {
        const int repetitions = is_plain && count == kManyNodes ? 1 : kRepetitions;
        add(costs_name(is_plain, count, order), repetitions,
            [=](Subjects& s) { return find_costs(s, is_plain, count, order); });
      }
    }
  }
  add(kRandom, kRepetitions, search_random);
  add(kIncremental, kRepetitions, [](Subjects& s) { return search_guided(s, WeightKind::incremental); });
  add(kPeriodic, kRepetitions, [](Subjects& s) { return search_guided(s, WeightKind::periodic); });
}

void add_searches(GoalTable& table, const Results& results) {
  const auto plain_by_ours = [&](int nodes, Order order) {
    return results.ratio(costs_name(true, nodes, order), costs_name(false, nodes, order));
  };
  table.add("nanoflann + Boost.Graph against ours, 33,000 nodes", plain_by_ours(kFigureNodes, Order::cells),
            "x", Goal{6.0, 10.0, false});
  table.add("  in random order, sorting them included", plain_by_ours(kFigureNodes, Order::random), "x");
  table.add("nanoflann + Boost.Graph against ours, 1 million nodes in random order",
            plain_by_ours(kManyNodes, Order::random), "x", Goal{20.0, 40.0, false});
  table.add("  in the order of cells", plain_by_ours(kManyNodes, Order::cells), "x");
  const Goal guided{1.7, 1.4};
  table.add("guiding vectors against random weights, same queue, incremental",
            results.ratio(kIncremental, kRandom), "x", guided);
  table.add("  periodic", results.ratio(kPeriodic, kRandom), "x", guided);
}

std::optional<std::string> plain_cost_difference(int nodes) {
  const Mushroom mushroom(nodes);
  const Graph graph = mushroom.graph(mushroom.nodes.position);
  const std::vector<double> ours = shortest_paths(graph, kRoot).cost;
  const std::vector<double> plain = plain_paths(graph).cost;
  for (std::size_t node = 0; node < graph.nodes.size(); ++node) {
    if (std::abs(ours[node] - plain[node]) <= kTolerance * plain[node]) continue;
    return fmt::format("node {} of {}: cost {} in pathplan/, {} by Boost.Graph", node, nodes, ours[node],
                       plain[node]);
  }
  fmt::print("{} nodes: pathplan/ and Boost.Graph find the same costs on the same {} edges\n", nodes,
             graph.edges.size());
  return std::nullopt;
}

}  // namespace ramify::bench
