#include "pathplan/guiding.h"

#include <functional>
#include <set>

#include "pathplan/path_union.h"
#include "tests/catch.h"
#include "tests/pathplan/graphs.h"

using namespace ramify;
using namespace ramify::pathplan;
using namespace ramify::test;

namespace {

/// The vector of a node from that of its parent.
using GuideRule = std::function<Guide(const Guide& before, std::uint32_t parent, std::uint32_t node)>;

struct PlainSearch {
  std::vector<double> cost;
  std::vector<std::uint32_t> parent;
  std::vector<Guide> guides;
};

/// The definition: the least label by (cost, number) is settled, gets its vector from its final parent's, and
/// only then its edges are costed.
PlainSearch plain_search(const Graph& graph, double epsilon, const std::vector<std::uint32_t>& sources,
                         const std::vector<Guide>& source_guides, const GuideRule& rule,
                         bool has_cost_factors = false) {
  const std::size_t count = graph.nodes.size();
  PlainSearch found{std::vector<double>(count, kUnreached), std::vector<std::uint32_t>(count, kNoParent),
                    source_guides};
  std::vector<std::vector<std::pair<std::uint32_t, double>>> links(count);
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    links[graph.edges[i][0]].emplace_back(graph.edges[i][1], graph.weights[i]);
    links[graph.edges[i][1]].emplace_back(graph.edges[i][0], graph.weights[i]);
  }
  std::set<std::pair<double, std::uint32_t>> labels;
  for (const std::uint32_t source : sources) labels.emplace(found.cost[source] = 0.0, source);
  while (!labels.empty()) {
    const auto [cost, u] = *labels.begin();
    labels.erase(labels.begin());
    if (found.parent[u] != kNoParent)
      found.guides[u] = rule(found.guides[found.parent[u]], found.parent[u], u);
    for (const auto& [v, weight] : links[u]) {
      // A weight is a length, rounded to single precision, times a factor if there are such.
      const double length = glm::distance(graph.nodes[u], graph.nodes[v]);
      const double along = has_cost_factors ? weight : length;
      const Vec3 e = (graph.nodes[v] - graph.nodes[u]) / length;
      const double there = cost + weight * (1.0 + epsilon) - along * glm::dot(found.guides[u].vector, e);
      if (there >= found.cost[v]) continue;
      labels.erase({found.cost[v], v});
      labels.emplace(found.cost[v] = there, v);
      found.parent[v] = u;
    }
  }
  return found;
}

double farthest_from_root(const Graph& graph) {
  double farthest = 0.0;
  for (const Vec3& node : graph.nodes) farthest = std::max(farthest, glm::distance(node, graph.nodes[0]));
  return farthest;
}

/// Incremental, by its definition: in the plane of the trunk's axis and the node, from the axis outwards.
GuideRule incremental_rule(const Graph& graph, const Guiding& guiding, double spacing, const Vec3& axis) {
  const double farthest = farthest_from_root(graph);
  return [&graph, &guiding, spacing, axis, farthest](const Guide& before, std::uint32_t parent,
                                                     std::uint32_t node) {
    const Vec3 from_root = graph.nodes[node] - graph.nodes[0];
    const Vec3 aside = from_root - axis * glm::dot(from_root, axis);
    if (glm::length(aside) < spacing) return before;
    const Vec3 out = glm::normalize(aside);
    const double way = glm::distance(graph.nodes[parent], graph.nodes[node]);
    const double alpha = radians(guiding.alpha_deg.at(glm::length(from_root) / farthest));
    const double limit = radians(guiding.max_turn_deg);
    const double turned = std::min(limit, std::max(-limit, before.progress + alpha * way / spacing));
    const double turn = turned - before.progress;
    const double along = glm::dot(before.vector, axis);
    const double outwards = glm::dot(before.vector, out);
    const Vec3 rest = before.vector - along * axis - outwards * out;
    return Guide{.vector = rest + axis * (along * std::cos(turn) - outwards * std::sin(turn)) +
                           out * (along * std::sin(turn) + outwards * std::cos(turn)),
                 .progress = turned};
  };
}

/// Periodic: constant until the way since the last turn is long enough. Where to it turns is drawn, so that
/// is taken from what was found; the tests look at its angle.
GuideRule periodic_rule(const Graph& graph, const Guiding& guiding, const std::vector<Guide>& found) {
  const double farthest = farthest_from_root(graph);
  double edge_length = 0.0;
  for (const auto& [a, b] : graph.edges) edge_length += glm::distance(graph.nodes[a], graph.nodes[b]);
  edge_length /= static_cast<double>(graph.edges.size());
  return [&graph, &guiding, &found, farthest, edge_length](const Guide& before, std::uint32_t parent,
                                                           std::uint32_t node) {
    const double walked = before.progress + glm::distance(graph.nodes[parent], graph.nodes[node]);
    const double period = guiding.d.at(glm::distance(graph.nodes[node], graph.nodes[0]) / farthest);
    if (walked < period * edge_length) return Guide{.vector = before.vector, .progress = walked};
    return Guide{.vector = found[node].vector};
  };
}

std::vector<Guide> root_guide(const Graph& graph, const Vec3& axis) {
  std::vector<Guide> guides(graph.nodes.size());
  guides[0].vector = axis;
  return guides;
}

Level level_of(WeightKind kind, const Guiding& guiding) {
  Level level;
  level.weights = kind;
  level.guiding = guiding;
  return level;
}

/// Checks costs, parents and vectors of a search against the definition.
void check_search(const ShortestPaths& paths, const GuidedSearch& search, const PlainSearch& plain) {
  CHECK(paths.parent == plain.parent);
  for (std::size_t node = 0; node < paths.cost.size(); ++node) {
    if (plain.cost[node] == kUnreached) {
      REQUIRE(paths.cost[node] == kUnreached);
      continue;
    }
    REQUIRE(std::abs(paths.cost[node] - plain.cost[node]) <= 1e-9 * plain.cost[node]);
    const Guide& guide = search.guides()[node];
    REQUIRE(std::abs(glm::length(guide.vector) - 1.0) < 1e-9);
    REQUIRE(glm::distance(guide.vector, plain.guides[node].vector) < 1e-9);
    REQUIRE(std::abs(guide.progress - plain.guides[node].progress) < 1e-9);
  }
}

/// A chain of nodes, each joined to the next.
Graph chain(std::vector<Vec3> nodes) {
  std::vector<Edge> edges;
  for (std::uint32_t i = 1; i < nodes.size(); ++i) edges.push_back({i - 1, i});
  Graph graph;
  graph.nodes = std::move(nodes);
  graph.edges = std::move(edges);
  assign_lengths(graph);
  link_nodes(graph);
  return graph;
}

double angle_deg(const Vec3& a, const Vec3& b) {
  return degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

/// A graph whose edges cost `low` to `high` times as much as they would.
Graph guided_graph(const Place& place, int nodes, std::uint64_t seed, double low = 1.0, double high = 1.0) {
  return graph_in(place, nodes, {.exponent = 1.0, .low = low, .high = high, .seed = seed});
}

double spacing_of(const Place& place, int nodes) {
  return wanted_spacing({.nodes = nodes}, volume_of(place.volume));
}

}  // namespace

TEST_CASE("guiding: an edge costs its length times 1 - cosine + epsilon, times its factor") {
  const Graph graph = graph_of({{0, 0, 0}, {0, 1, 0}, {2, 0, 0}, {0, -1, 0}, {0, 3, 4}},
                               {{0, 1}, {0, 2}, {0, 3}, {0, 4}}, {1.0f, 2.0f, 1.0f, 10.0f});
  const Level level = level_of(WeightKind::incremental, {.alpha_deg = 0.0, .epsilon = 0.25});
  GuidedSearch search(graph, level, 1.0, kUp, 1, true);
  const std::vector<double> expected = {0.0, 0.25, 2.5, 2.25, 2.0 * 5.0 * (1.25 - 0.6)};
  const ShortestPaths paths = search.paths_from(kRoot);
  for (std::size_t i = 0; i < 5; ++i) CHECK(std::abs(paths.cost[i] - expected[i]) < 1e-12);
  CHECK(std::abs(search.cost(1, 0, 1.0) - 2.25) < 1e-12);  // back: against the vector
}

TEST_CASE("guiding: incremental vectors turn outwards by alpha for each spacing, as far as max_turn") {
  std::vector<Vec3> nodes;
  for (int i = 0; i < 9; ++i) nodes.emplace_back(i, 0.0, 0.0);
  const Graph graph = chain(nodes);
  const Level level = level_of(WeightKind::incremental, {.alpha_deg = 30.0, .max_turn_deg = 150.0});
  GuidedSearch search(graph, level, 1.0, kUp, 1);
  const ShortestPaths paths = search.paths_from(kRoot);
  for (int i = 0; i < 9; ++i) {
    const double angle = radians(std::min(30.0 * i, 150.0));
    CHECK(glm::distance(search.guides()[static_cast<std::size_t>(i)].vector,
                        {std::sin(angle), std::cos(angle), 0.0}) < 1e-12);
  }
  CHECK(std::abs(paths.cost[2] - (1.1 + 0.6)) < 1e-12);

  // Half the spacing is twice the turn; a negative angle turns inwards.
  const Level inwards = level_of(WeightKind::incremental, {.alpha_deg = -10.0, .max_turn_deg = 45.0});
  GuidedSearch other(graph, inwards, 0.5, kUp, 1);
  other.paths_from(kRoot);
  CHECK(glm::distance(other.guides()[1].vector, {-std::sin(radians(20.0)), std::cos(radians(20.0)), 0.0}) <
        1e-12);
  CHECK(std::abs(angle_deg(other.guides()[8].vector, kUp) - 45.0) < 1e-9);
}

TEST_CASE("guiding: incremental vectors do not turn within a spacing of the trunk's axis") {
  const Graph graph =
      chain({{1, 0, 0}, {1, 1, 0}, {1.9, 2, 0}, {1, 3, 0.99}, {1, 4, 1.01}, {1.5, 5, 0}});  // the root aside
  const Level level = level_of(WeightKind::incremental, {.alpha_deg = 20.0});
  GuidedSearch search(graph, level, 1.0, kUp, 1);
  search.paths_from(kRoot);
  for (const std::size_t node : {0, 1, 2, 3}) CHECK(search.guides()[node].vector == kUp);
  CHECK(angle_deg(search.guides()[4].vector, kUp) > 19.0);
  CHECK(search.guides()[4].vector.z > 0.3);
  CHECK(search.guides()[5].vector == search.guides()[4].vector);
}

TEST_CASE("guiding: incremental costs, paths and vectors are those of the definition") {
  const std::vector<Guiding> kinds = {
      {.alpha_deg = 8.0},
      {.alpha_deg = 30.0, .max_turn_deg = 90.0, .epsilon = 0.02},
      {.alpha_deg = Schedule({{0.0, 0.0}, {0.4, 3.0}, {1.0, 40.0}}), .max_turn_deg = 360.0, .epsilon = 1.0},
      {.alpha_deg = Schedule({{0.0, -20.0}, {1.0, 20.0}}), .max_turn_deg = 30.0},
  };
  for (const Place& place : places()) {
    for (const Guiding& guiding : kinds) {
      for (const Vec3& axis : {kUp, glm::normalize(Vec3(1.0, -1.0, 0.5))}) {
        INFO(place.name << ", max_turn " << guiding.max_turn_deg << ", axis " << axis.x);
        const double spacing = spacing_of(place, 900);
        const Graph graph = guided_graph(place, 900, 1, 0.5, axis == kUp ? 0.5 : 2.0);
        const Level level = level_of(WeightKind::incremental, guiding);
        GuidedSearch search(graph, level, spacing, axis, 1, true);
        const ShortestPaths paths = search.paths_from(kRoot);
        check_search(paths, search,
                     plain_search(graph, guiding.epsilon, kRoot, root_guide(graph, axis),
                                  incremental_rule(graph, guiding, spacing, axis), true));
      }
    }
  }
}

TEST_CASE("guiding: periodic vectors are constant for d mean edges, then turn by exactly alpha") {
  std::vector<Vec3> nodes;
  for (int i = 0; i < 20; ++i) nodes.emplace_back(0.0, i, 0.0);
  const Graph graph = chain(nodes);
  const Level level = level_of(WeightKind::periodic, {.alpha_deg = 50.0, .d = 3.0});
  GuidedSearch search(graph, level, 1.0, kUp, 1);
  search.paths_from(kRoot);
  for (std::size_t i = 1; i < 20; ++i) {
    const Vec3& before = search.guides()[i - 1].vector;
    const Vec3& after = search.guides()[i].vector;
    if (i % 3 != 0) CHECK(after == before);
    if (i % 3 == 0) CHECK(std::abs(angle_deg(before, after) - 50.0) < 1e-9);
  }
}

TEST_CASE("guiding: periodic costs and paths are those of the definition, by every period and angle") {
  for (const Place& place : places()) {
    for (const Schedule& d : {Schedule(1.0), Schedule(5.0), Schedule({{0.0, 8.0}, {1.0, 2.0}})}) {
      for (const Schedule& alpha : {Schedule(30.0), Schedule({{0.0, 90.0}, {1.0, 10.0}})}) {
        INFO(place.name << ", d " << d.at(0.0) << ", alpha " << alpha.at(0.0));
        const Graph graph = guided_graph(place, 900, 2, 0.5, 1.0);
        const Guiding guiding{.alpha_deg = alpha, .d = d};
        const Level level = level_of(WeightKind::periodic, guiding);
        GuidedSearch search(graph, level, 1.0, kUp, 3, true);
        const ShortestPaths paths = search.paths_from(kRoot);
        const std::vector<Guide>& guides = search.guides();
        check_search(paths, search,
                     plain_search(graph, guiding.epsilon, kRoot, root_guide(graph, kUp),
                                  periodic_rule(graph, guiding, guides), true));
        int turns = 0;
        for (std::uint32_t node = 1; node < graph.nodes.size(); ++node) {
          if (!paths.is_reached(node) || guides[node].progress != 0.0) continue;
          ++turns;
          const double share = glm::distance(graph.nodes[node], graph.nodes[0]) / farthest_from_root(graph);
          REQUIRE(std::abs(angle_deg(guides[paths.parent[node]].vector, guides[node].vector) -
                           alpha.at(share)) < 1e-6);
        }
        CHECK(turns > 30);
      }
    }
  }
}

TEST_CASE("guiding: periodic turns go to all sides alike, and belong to the seed and the node") {
  const Graph graph = guided_graph(places()[0], 8000, 1);
  const Level level = level_of(WeightKind::periodic, {.alpha_deg = 40.0, .d = 2.0});
  GuidedSearch search(graph, level, 1.0, kUp, 1);
  const ShortestPaths paths = search.paths_from(kRoot);
  int quarters[4] = {};
  int turns = 0;
  for (std::uint32_t node = 1; node < graph.nodes.size(); ++node) {
    if (search.guides()[node].progress != 0.0) continue;
    const Vec3& before = search.guides()[paths.parent[node]].vector;
    const Vec3 side = any_perpendicular(before);
    const double x = glm::dot(search.guides()[node].vector, side);
    const double y = glm::dot(search.guides()[node].vector, glm::cross(before, side));
    ++quarters[(x < 0 ? 1 : 0) + (y < 0 ? 2 : 0)];
    ++turns;
  }
  CHECK(turns > 2000);
  for (const int quarter : quarters) CHECK(std::abs(quarter - turns / 4) < 4 * std::sqrt(turns * 3.0 / 16.0));

  GuidedSearch again(graph, level, 1.0, kUp, 1);
  CHECK(again.paths_from(kRoot).cost == paths.cost);
  GuidedSearch other(graph, level, 1.0, kUp, 2);
  CHECK(other.paths_from(kRoot).cost != paths.cost);
}

TEST_CASE("guiding: angles of a table are drawn as often as it says, in place of alpha") {
  const Graph graph = guided_graph(places()[0], 12'000, 1);
  const Level level =
      level_of(WeightKind::periodic,
               {.alpha_deg = 5.0, .chances = {{1.0, 90.0}, {6.0, 30.0}, {3.0, -60.0}}, .d = 2.0});
  GuidedSearch search(graph, level, 1.0, kUp, 1);
  const ShortestPaths paths = search.paths_from(kRoot);
  int turns = 0;
  int found[3] = {};
  for (std::uint32_t node = 1; node < graph.nodes.size(); ++node) {
    if (search.guides()[node].progress != 0.0) continue;
    ++turns;
    const double angle = angle_deg(search.guides()[paths.parent[node]].vector, search.guides()[node].vector);
    const double angles[] = {90.0, 30.0, 60.0};
    for (int i = 0; i < 3; ++i) found[i] += std::abs(angle - angles[i]) < 1e-6 ? 1 : 0;
  }
  REQUIRE(turns > 3000);
  CHECK(found[0] + found[1] + found[2] == turns);
  const double shares[] = {0.1, 0.6, 0.3};
  for (int i = 0; i < 3; ++i) {
    const double deviation = std::sqrt(turns * shares[i] * (1.0 - shares[i]));
    CHECK(std::abs(found[i] - turns * shares[i]) < 4.0 * deviation);
  }
}

TEST_CASE("guiding: in later searches sources keep their vectors, and the others follow from these") {
  for (const Place& place : places()) {
    for (const WeightKind kind : {WeightKind::incremental, WeightKind::periodic}) {
      INFO(place.name << ", kind " << static_cast<int>(kind));
      const double spacing = spacing_of(place, 900);
      const Graph graph = guided_graph(place, 900, 3);
      const Guiding guiding{.alpha_deg = 15.0, .d = 3.0};
      const Level level = level_of(kind, guiding);
      GuidedSearch search(graph, level, spacing, kUp, 1);
      PathUnion paths(graph.nodes.size());
      const ShortestPaths first = search.paths_from(kRoot);
      std::vector<std::uint32_t> endpoints = {100, 300, 500, 700};
      std::erase_if(endpoints, [&](std::uint32_t node) { return !first.is_reached(node); });
      paths.add(first, endpoints);
      REQUIRE(paths.nodes().size() > 8);
      const std::vector<Guide> before = search.guides();

      const ShortestPaths second = search.paths_from(paths.nodes());
      for (const std::uint32_t node : paths.nodes()) {
        CHECK(second.cost[node] == 0.0);
        CHECK(search.guides()[node].vector == before[node].vector);
      }
      const GuideRule rule = kind == WeightKind::incremental ? incremental_rule(graph, guiding, spacing, kUp)
                                                             : periodic_rule(graph, guiding, search.guides());
      std::vector<Guide> kept(graph.nodes.size());
      for (const std::uint32_t node : paths.nodes()) kept[node] = before[node];
      check_search(second, search, plain_search(graph, guiding.epsilon, paths.nodes(), kept, rule));
    }
  }
}

TEST_CASE("guiding: a stop request leaves all but the sources unreached") {
  std::stop_source stop;
  stop.request_stop();
  const Graph graph = guided_graph(places()[0], 300, 1);
  const Level level = level_of(WeightKind::incremental, {});
  GuidedSearch search(graph, level, 1.0, kUp, 1);
  const ShortestPaths paths = search.paths_from(kRoot, stop.get_token());
  CHECK(paths.is_reached(0));
  CHECK(std::count(paths.cost.begin(), paths.cost.end(), kUnreached) == 299);
}
