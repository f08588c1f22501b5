// Wood that leaves the plant: shed, cut or pruned.

#include "growth/cutting.h"

#include "common/base/rng.h"
#include "growth/pruning.h"
#include "growth/shedding.h"
#include "growth/simulation.h"
#include "tests/catch.h"
#include "tests/growth/plants.h"
#include "tests/growth/runs.h"

using namespace ramify;
using namespace ramify::growth;
using namespace ramify::test;

namespace {

using Nodes = std::vector<std::uint32_t>;

/// A trunk of nodes 1, 2 and 5, with an axis of nodes 3 and 4 on node 1.
Plant forked() {
  Plant plant = test::seedling();
  plant.buds.clear();
  plant.bud_direction.clear();
  add_node(plant, 0, 0);
  add_node(plant, 1, 0);
  add_node(plant, 1, 1);
  add_node(plant, 3, 1);
  add_node(plant, 2, 0);
  return plant;
}

}  // namespace

TEST_CASE("cutting: all that grows from a cut goes with it, and the tips are remembered below") {
  Plant plant = forked();
  CHECK(nodes_beyond(plant, {3}) == Nodes{3, 4});
  CHECK(nodes_beyond(plant, {5, 1}) == Nodes{1, 2, 3, 4, 5});
  CHECK(nodes_beyond(plant, {}).empty());
  cut_away(plant, nodes_beyond(plant, {3}));
  CHECK(plant.internode_count() == 3);
  CHECK(plant.is_cut(3));
  CHECK(plant.lost_tips[1] == 1);
  cut_away(plant, nodes_beyond(plant, {1}));
  CHECK(plant.lost_tips[0] == 2);
  CHECK(plant.internode_count() == 0);
}

TEST_CASE("cutting: what has grown since from nodes that go goes with them") {
  Plant plant = forked();
  Nodes nodes = nodes_beyond(plant, {3});
  Nodes none;
  add_node(plant, 4, 1);
  add_node(plant, 5, 0);
  add_node(plant, 6, 1);
  follow_growth(plant, 6, nodes);
  follow_growth(plant, 6, none);
  CHECK(nodes == nodes_beyond(plant, {3}));
  CHECK(nodes == Nodes{3, 4, 6, 8});
  CHECK(none.empty());
}

TEST_CASE("cutting: closing the holes leaves the living as they were") {
  Plant plant = forked();
  plant.position[5] = {5, 5, 5};
  plant.buds = {{.node = kNone}, {.node = 4}, {.node = 5, .is_terminal = true}};
  plant.bud_direction.resize(plant.buds.size());
  cut_away(plant, nodes_beyond(plant, {3}));
  compact(plant, 0.9);
  CHECK(plant.node_count() == 6);  // not enough of them yet
  CHECK(plant.buds.size() == 1);
  compact(plant, 0.0);
  CHECK(plant.node_count() == 4);
  CHECK(plant.axes.size() == 1);
  CHECK(plant.position[3] == Vec3(5, 5, 5));
  CHECK(plant.parent == Nodes{kNone, 0, 1, 2});
  REQUIRE(plant.buds.size() == 1);
  CHECK(plant.buds[0].node == 3);
  CHECK(plant.axes_founded == 2);
}

TEST_CASE("cutting: whatever is cut, what is left of a large plant stays as it was, in its order") {
  for (const double share : {0.0, 0.001, 0.02, 0.2, 0.9}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      CAPTURE(share, seed);
      Rng random = Rng::stream(seed, Stream::bud, 0);
      Plant plant = test::seedling();
      for (std::uint32_t node = 1; node < 200 + 61 * seed; ++node) {
        const auto parent = static_cast<std::uint32_t>(random.below(node));
        const bool founds = random.uniform() < 0.3;
        const std::uint32_t axis = founds ? plant.axes_founded : plant.axis[parent];
        add_node(plant, parent, axis, Vec3(node));  // where it is tells which it was
        plant.lost_tips.back() = node;
        add_bud(plant, {.node = node, .is_terminal = true}, Vec3f(plant.position.back()));
      }
      Nodes cuts;
      for (std::uint32_t node = 1; node < plant.node_count(); ++node) {
        if (random.uniform() < share) cuts.push_back(node);
      }
      cut_away(plant, nodes_beyond(plant, cuts));
      const Plant before = plant;
      compact(plant, 0.0);

      std::uint32_t left = 0;
      for (std::uint32_t old = 0; old < before.node_count(); ++old) {
        if (before.is_cut(old)) continue;
        REQUIRE(left < plant.node_count());
        CHECK(plant.position[left] == before.position[old]);
        CHECK(plant.lost_tips[left] == before.lost_tips[old]);
        CHECK(plant.founds_axis[left] == before.founds_axis[old]);
        const Axis& axis = plant.axes[plant.axis[left]];
        CHECK(axis.id == before.axes[before.axis[old]].id);
        CHECK(plant.position[axis.first] == before.position[before.axes[before.axis[old]].first]);
        if (old > 0) {
          CHECK(plant.position[plant.parent[left]] == before.position[before.parent[old]]);
          CHECK(plant.buds[left].node == left);
          CHECK(plant.bud_direction[left] == Vec3f(before.position[old]));
        }
        ++left;
      }
      CHECK(plant.node_count() == left);
      CHECK(plant.buds.size() == left);
      CHECK(plant.cut_nodes == 0);
    }
  }
}

TEST_CASE("shedding: an axis is judged by light an internode, not before its time, and only by light") {
  TreeParameters tree;
  tree.shed_threshold = 0.5;
  Plant plant = forked();
  add_bud(plant, {.node = 4, .is_terminal = true});
  LightSums sums;
  sum_light(plant, {1.0}, sums);
  CHECK(shaded_axes(plant, sums, tree, 2).empty());  // 1 / 2 is not below
  sum_light(plant, {0.99}, sums);
  CHECK(shaded_axes(plant, sums, tree, 2) == Nodes{3});
  tree.shed_after = 2;
  CHECK(shaded_axes(plant, sums, tree, 2).empty());
  CHECK(shaded_axes(plant, sums, tree, 3).size() == 1);
  tree.shed_by = ShedBy::vigour;
  CHECK(shaded_axes(plant, sums, tree, 3).empty());
}

TEST_CASE("shedding: by vigour an internode is judged by resource an internode, anywhere") {
  TreeParameters tree;
  tree.shed_by = ShedBy::vigour;
  tree.shed_threshold = 0.3;
  Plant plant = forked();
  plant.buds = {{.node = 4}, {.node = 5}};
  LightSums sums;
  sum_light(plant, {0.0, 0.0}, sums);
  // Node 5 gets 0.2, nodes 2 to 5 0.2 / 2, 3 to 4 0.8 / 2, 1 all: 1 / 5.
  CHECK(starved_internodes(plant, sums, {0.8, 0.2}, tree, 1) == Nodes{1, 2, 5});
  tree.shed_threshold = 0.15;
  CHECK(starved_internodes(plant, sums, {0.8, 0.2}, tree, 1) == Nodes{2});
  tree.shed_by = ShedBy::light;
  CHECK(starved_internodes(plant, sums, {0.8, 0.2}, tree, 1).empty());
}

TEST_CASE("shedding: in a run whole axes go, the trunk never, and none of their buds stays") {
  const Parameters parameters = growth_parameters("p09-fig7-50", {"growth.shed_threshold=0.4"});
  Simulation simulation(parameters, true);
  for (int i = 0; i < 12; ++i) REQUIRE(simulation.advance());
  const GrowingTree& tree = simulation.trees()[0];
  const History& history = *tree.history;
  std::size_t shed = 0;
  for (std::size_t node = 1; node < history.position.size(); ++node) {
    if (history.shed_step[node] == kAlive) continue;
    ++shed;
    CHECK(history.axis_id[node] != 0);
    CHECK(history.shed_step[node] >= history.birth_step[node]);  // equal: it grew on an axis then shed
  }
  CHECK(shed > 100);
  CHECK(history.position.size() == shed + tree.plant.internode_count() + 1);
  for (std::size_t node = 1; node < history.position.size(); ++node) {
    // What grew on shed wood went with it.
    const auto below = history.shed_step[history.parent[node]];
    if (below != kAlive) CHECK(history.shed_step[node] <= below);
  }
  for (const Bud& bud : tree.plant.buds) CHECK_FALSE((bud.is_dead() || tree.plant.is_cut(bud.node)));
}

TEST_CASE("pruning: an event is due at its step, and again after so many") {
  PruneEvent event;
  event.step = 3;
  CHECK_FALSE(is_due(event, 2));
  CHECK(is_due(event, 3));
  CHECK_FALSE(is_due(event, 4));
  event.every = 2;
  CHECK_FALSE(is_due(event, 1));
  CHECK(is_due(event, 3));
  CHECK_FALSE(is_due(event, 4));
  CHECK(is_due(event, 7));
}

TEST_CASE("pruning: after the event no living internode ends on the cut side, and stumps sprout again") {
  for (const char* side : {"outside", "inside"}) {
    // The trunk stays: what is cut out lies beside it.
    const std::string center = std::string(side) == "outside" ? "[0.0, 0.5, 0.0]" : "[0.6, 0.5, 0.0]";
    const std::string event = std::string("growth.prune=[{step = 8, cut = \"") + side +
                              "\", volume = {shape = \"sphere\", center = " + center + ", radius = 0.55}}]";
    const Parameters parameters = growth_parameters("p09-fig7-50", {event, "growth.shed_threshold=0"});
    Simulation simulation(parameters, true);
    const Solid solid(parameters.prune[0].volume);
    for (int i = 0; i < 8; ++i) REQUIRE(simulation.advance());
    const GrowingTree& tree = simulation.trees()[0];
    const std::size_t left = tree.plant.internode_count();
    CHECK(left > 3);
    CHECK(left + 50 < tree.history->position.size());
    for (std::size_t node = 1; node < tree.plant.node_count(); ++node) {
      if (tree.plant.is_cut(node)) continue;
      CHECK(solid.contains(tree.plant.position[node]) == (std::string(side) == "outside"));
    }
    for (std::size_t node = 1; node < tree.history->position.size(); ++node) {
      const auto shed = tree.history->shed_step[node];
      CHECK((shed == kAlive || shed == 8));
    }
    for (int i = 0; i < 3; ++i) REQUIRE(simulation.advance());
    CHECK(simulation.trees()[0].plant.internode_count() > left);
  }
}
