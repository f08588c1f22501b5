#include "growth/shoots.h"

#include <algorithm>

#include "growth/shoot_building.h"
#include "tests/catch.h"
#include "tests/growth/plants.h"

using namespace ramify;
using namespace ramify::growth;

namespace {

/// Makes shoots with this vigour a bud in an unshaded world.
void grow(Plant& plant, const Parameters& parameters, const MappedVector<double>& vigour, int step = 1) {
  ShadowGrid shadow({}, parameters.voxel_edge());
  const LightField field(shadow, parameters.shadow, 1);
  Barriers barriers(parameters);
  barriers.set_step(step);
  const MappedVector<double> exposure;
  const MappedVector<Vec3f> space;
  std::vector<Shoot> shoots = ShootPlanner(plant, vigour, parameters, step).next(100'000);
  const Guides guides{parameters, parameters, parameters.seed, barriers, field, exposure, space};
  const Traces traces = trace_shoots(shoots, plant, guides, step);
  CasterChanges changes;
  build_shoots(plant, shoots, traces, parameters, parameters, shadow, step, changes);
  // The shadow had no leaf before.
  const auto is_settled = [&](const Bud& bud) {
    return bud.is_dead() || bud.birth_step != step ||
           bud.site == shadow.site_of(shadow.voxel_of(plant.position[bud.node]));
  };
  CHECK(std::ranges::all_of(plant.buds, is_settled));
  compact(plant, 0.0);
}

auto dead_buds(const Plant& plant) {
  return std::count_if(plant.buds.begin(), plant.buds.end(), [](const Bud& bud) { return bud.is_dead(); });
}

/// A seedling after one step with this vigour at its only bud.
Plant grown(const Parameters& parameters, double vigour) {
  Plant plant = seedling(parameters.planted().front(), 0);
  grow(plant, parameters, {vigour});
  return plant;
}

/// Every node, axis and bud has been written, and says what its neighbours say.
void check_whole(const Plant& plant) {
  std::vector<std::uint32_t> nodes_of_axis(plant.axes.size(), 0);
  for (std::uint32_t node = 0; node < plant.node_count(); ++node) {
    const Axis& axis = plant.axes.at(plant.axis[node]);
    ++nodes_of_axis[plant.axis[node]];
    const bool is_first = axis.first == node;
    if (node == 0) continue;
    REQUIRE(plant.parent[node] < node);
    REQUIRE(bool(plant.founds_axis[node]) == is_first);
    if (is_first) REQUIRE(axis.order == plant.axes[plant.axis[plant.parent[node]]].order + 1);
    if (!is_first) REQUIRE(plant.axis[plant.parent[node]] == plant.axis[node]);
    REQUIRE(plant.birth_step[node] >= std::max<int>(1, plant.birth_step[plant.parent[node]]));
    REQUIRE(glm::length(plant.position[node] - plant.position[plant.parent[node]]) > 0.0);
  }
  std::vector<int> tips_of_axis(plant.axes.size(), 0);
  for (std::size_t i = 0; i < plant.buds.size(); ++i) {
    const Bud& bud = plant.buds[i];
    REQUIRE(bud.node < plant.node_count());
    REQUIRE(glm::length(plant.bud_direction[i]) == Approx(1.0f));
    if (bud.is_terminal) ++tips_of_axis[plant.axis[bud.node]];
  }
  for (std::size_t i = 0; i < plant.axes.size(); ++i) {
    REQUIRE(plant.axes[i].node_count == nodes_of_axis[i]);
    REQUIRE(glm::length(plant.axes[i].reference) == Approx(1.0f));
    REQUIRE(tips_of_axis[i] == 1);
    if (i > 0) REQUIRE(plant.axes[i].id > plant.axes[i - 1].id);
  }
}

std::size_t axillary_buds(const Plant& plant) {
  std::size_t count = 0;
  for (const Bud& bud : plant.buds) count += !bud.is_terminal;
  return count;
}

}  // namespace

TEST_CASE("shoots: a bud with v < 1 rests, one a rounding error below grows") {
  CHECK(grown(Parameters{}, 0.999).internode_count() == 0);
  CHECK(grown(Parameters{}, 0.999).buds.size() == 1);
  CHECK(grown(Parameters{}, 1.0 - 1e-10).internode_count() == 1);
}

TEST_CASE("shoots: thousands at once make whole plants, whatever buds a tip has") {
  for (const Phyllotaxis phyllotaxis : {Phyllotaxis::spiral, Phyllotaxis::opposite, Phyllotaxis::whorled}) {
    for (const TipBud tip_bud : {TipBud::both, TipBud::terminal}) {
      for (const bool sympodial : {false, true}) {
        Parameters parameters;
        parameters.phyllotaxis = phyllotaxis;
        parameters.tip_bud = tip_bud;
        parameters.sympodial = sympodial;
        parameters.ground = false;  // in whose way buds die
        Plant plant = seedling(parameters.planted().front(), 0);
        for (int step = 1; step < 30 && plant.buds.size() < 3000; ++step) {
          // Some rest, some make one metamer and some two.
          MappedVector<double> vigour(plant.buds.size());
          for (std::size_t i = 0; i < vigour.size(); ++i) vigour[i] = double((i + 1) % 3) + 0.5;
          grow(plant, parameters, vigour, step);
        }
        INFO("phyllotaxis " << int(phyllotaxis) << ", tip_bud " << int(tip_bud) << ", sympodial "
                            << sympodial);
        check_whole(plant);
      }
    }
  }
}

TEST_CASE("shoots: v makes floor(v) metamers of length v / floor(v)") {
  Parameters parameters;
  parameters.internode_length = 0.1;
  parameters.max_metamers = 0;
  const Plant plant = grown(parameters, 3.6);
  REQUIRE(plant.internode_count() == 3);
  for (std::size_t i = 1; i <= 3; ++i) {
    CHECK(std::abs(glm::length(plant.position[i] - plant.position[i - 1]) - 0.12) < 1e-12);
  }
}

TEST_CASE("shoots: what is above the cap is lost, and the cap may be a fraction") {
  Parameters parameters;
  parameters.internode_length = 1.0;
  parameters.max_metamers = 2.5;
  const Plant plant = grown(parameters, 100.0);
  REQUIRE(plant.internode_count() == 2);
  CHECK(std::abs(glm::length(plant.position[1]) - 1.25) < 1e-12);
  CHECK(planned_metamers({100.0, 0.5, 1.0}, parameters, 1) == 3.0);
}

TEST_CASE("shoots: the last node bears both buds, or the terminal alone until it grows on") {
  Parameters parameters;
  parameters.tip_bud = TipBud::both;
  CHECK(axillary_buds(grown(parameters, 3.0)) == 3);
  parameters.tip_bud = TipBud::terminal;
  CHECK(axillary_buds(grown(parameters, 3.0)) == 3);  // the root's, and those of two inner nodes

  Plant plant = grown(parameters, 3.0);
  CHECK(plant.buds.size() == 4);
  MappedVector<double> vigour(plant.buds.size(), 0.0);
  vigour.back() = 1.0;
  CHECK(plant.buds.back().is_terminal);
  grow(plant, parameters, vigour, 2);
  CHECK(axillary_buds(plant) == 4);
}

TEST_CASE("shoots: without weights a shoot goes on in its default direction") {
  Parameters parameters;
  parameters.w_default = 0.0;
  parameters.w_optimal = 0.0;
  const Plant plant = grown(parameters, 4.0);
  CHECK(glm::length(plant.position.back() - Vec3(0, 0.4, 0)) < 1e-12);
}

TEST_CASE("shoots: nothing grows below ground, a bud blocked at once dies and later it stops") {
  Parameters parameters;
  parameters.tropism["down"] = {.weight = 10.0, .direction = Vec3(0, -2, 0)};
  parameters.w_optimal = 0.0;
  Plant plant = grown(parameters, 3.0);
  CHECK(plant.internode_count() == 0);
  CHECK(plant.buds.empty());

  parameters.ground_y = -0.25;
  plant = grown(parameters, 4.0);
  CHECK(plant.internode_count() == 2);
  CHECK(plant.buds.back().is_terminal);

  parameters.ground = false;
  CHECK(grown(parameters, 4.0).internode_count() == 4);
}

TEST_CASE("shoots: an obstacle stops a shoot, and kills a bud that it blocks at once") {
  Parameters parameters;
  parameters.w_optimal = 0.0;
  Obstacle ceiling;
  ceiling.volume = {.shape = Shape::cylinder, .center = {0, 0.25, 0}, .radius = 5.0, .height = 0.001};
  parameters.obstacles = {ceiling};
  Plant plant = grown(parameters, 4.0);
  CHECK(plant.internode_count() == 2);
  CHECK(plant.buds.back().is_terminal);

  // A wall thinner than an internode is not jumped.
  MappedVector<double> vigour(plant.buds.size(), 0.0);
  vigour.back() = 3.0;
  grow(plant, parameters, vigour, 2);
  CHECK(plant.internode_count() == 2);
  for (const Bud& bud : plant.buds) CHECK_FALSE(bud.is_terminal);
}

TEST_CASE("shoots: tropisms act on their axis orders alone, and plagiotropism takes to the horizontal") {
  Parameters parameters;
  parameters.w_optimal = 0.0;
  parameters.tropism["east"] = {.weight = 1.0, .direction = Vec3(3, 0, 0), .min_order = 0, .max_order = 0};
  parameters.tropism["flat"] = {.weight = 0.5, .towards = Towards::horizontal, .min_order = 1};
  parameters.branching_angle_deg = 45.0;
  Plant plant = grown(parameters, 2.0);
  const Vec3 trunk = plant.position[1] - plant.position[0];
  CHECK(std::abs(trunk.x - trunk.y) < 1e-9);

  MappedVector<double> vigour(plant.buds.size(), 0.0);
  const Vec3 bud(plant.bud_direction[0]);
  REQUIRE_FALSE(plant.buds[0].is_terminal);
  vigour[0] = 1.0;
  grow(plant, parameters, vigour, 2);
  const Vec3 flat = glm::normalize(Vec3(bud.x, 0, bud.z));
  const Vec3 lateral = glm::normalize(plant.position.back() - plant.position[plant.parent.back()]);
  CHECK(glm::length(lateral - glm::normalize(bud + 0.5 * flat)) < 1e-6);
}

TEST_CASE("shoots: slerp turns each metamer by a share of the angle to the pull") {
  Parameters parameters;
  parameters.w_optimal = 0.0;
  parameters.combine = Combine::slerp;
  parameters.tropism["east"] = {.weight = 0.25, .direction = Vec3(1, 0, 0)};
  Plant plant = grown(parameters, 2.0);
  const auto angle = [&](std::size_t node) {
    const Vec3 along = plant.position[node] - plant.position[node - 1];
    return degrees(std::atan2(along.x, along.y));
  };
  CHECK(std::abs(angle(1) - 22.5) < 1e-9);
  CHECK(std::abs(angle(2) - (22.5 + 0.25 * 67.5)) < 1e-9);

  parameters.tropism["east"].weight = 5.0;  // no more than turn_max
  plant = grown(parameters, 1.0);
  CHECK(std::abs(angle(1) - 0.4 * 90.0) < 1e-9);
}

TEST_CASE("shoots: the best direction is looked for at each metamer, or once a shoot") {
  Parameters parameters;
  parameters.optimal_from = OptimalFrom::gradient;
  parameters.w_optimal = 5.0;
  parameters.voxel_size = 0.1;
  const auto end = [&](OptimalPer per) {
    parameters.v_per = per;
    Plant plant = seedling(parameters.planted().front(), 0);
    ShadowGrid shadow({}, 0.1);
    shadow.cast(std::vector<Coord>{{1, 2, 0}, {1, 3, 0}, {2, 3, 1}});
    const LightField field(shadow, ShadowModel::additive, 1);
    Barriers barriers(parameters);
    const MappedVector<double> exposure;
    const MappedVector<Vec3f> space;
    std::vector<Shoot> shoots = ShootPlanner(plant, {4.0}, parameters, 1).next(1000);
    const Guides guides{parameters, parameters, 1, barriers, field, exposure, space};
    return trace_shoots(shoots, plant, guides, 1).position.back();
  };
  CHECK(glm::length(end(OptimalPer::metamer) - end(OptimalPer::shoot)) > 0.01);
}

TEST_CASE("shoots: a sympodial axis goes on from the axillary bud at its tip") {
  Parameters parameters;
  parameters.w_optimal = 0.0;
  parameters.sympodial = true;
  parameters.branching_angle_deg = 30.0;
  for (const TipBud tip_bud : {TipBud::both, TipBud::terminal}) {
    parameters.tip_bud = tip_bud;
    Plant plant = grown(parameters, 3.0);
    CHECK(axillary_buds(plant) == 2);  // of the two nodes before: the tip's goes on
    const Bud& tip = plant.buds.back();
    REQUIRE(tip.is_terminal);
    CHECK(tip.node == 3);
    CHECK(std::abs(degrees(std::acos(double(plant.bud_direction.back().y))) - 30.0) < 1e-3);
    MappedVector<double> vigour(plant.buds.size(), 0.0);
    vigour.back() = 2.0;
    grow(plant, parameters, vigour, 2);
    CHECK(plant.axes.size() == 1);  // the same axis
    CHECK(plant.axis.back() == 0);
  }
}

TEST_CASE("shoots: an axis of whorls that is sympodial leaves the others of its tip as laterals") {
  Parameters parameters;
  parameters.sympodial = true;
  parameters.phyllotaxis = Phyllotaxis::whorled;
  parameters.whorl_buds = 4;
  const Plant plant = grown(parameters, 2.0);
  CHECK(axillary_buds(plant) == 4 + 3);
  CHECK(plant.buds.size() == 8);
}

TEST_CASE("buds: one that has rested for bud_lifespan steps dies, one that grew begins anew") {
  Parameters parameters;
  parameters.bud_lifespan = 3.0;
  Plant plant = grown(parameters, 2.0);  // made in step 1
  const ShadowGrid shadow({}, 0.1);
  CasterChanges changes;
  abort_buds(plant, parameters, parameters, shadow, 3, changes);
  CHECK(dead_buds(plant) == 0);
  MappedVector<double> vigour(plant.buds.size(), 0.0);
  vigour.back() = 1.0;
  grow(plant, parameters, vigour, 3);
  CHECK(plant.buds.size() == 4);
  abort_buds(plant, parameters, parameters, shadow, 4, changes);
  CHECK(dead_buds(plant) == 2);
  compact(plant, 0.0);
  for (const Bud& bud : plant.buds) CHECK(bud.birth_step == 3);
  CHECK(changes.removed.empty());

  parameters.casters = Casters::buds;
  abort_buds(plant, parameters, parameters, shadow, 6, changes);
  CHECK(changes.removed.size() == 2);
}

TEST_CASE("shoots: the planner finds every bud with resource, in order, however few it is asked for") {
  Plant plant = ramify::test::seedling();
  MappedVector<double> vigour = {0.0};
  std::vector<std::uint32_t> growing;
  for (std::uint32_t bud = 1; bud < 10000; ++bud) {
    ramify::test::add_bud(plant, {.node = 0, .is_terminal = true});
    const bool grows = bud % 7 == 0 || bud > 9900;
    vigour.push_back(grows ? 1.0 - 1e-12 : 1.0 - 1e-6);
    if (grows) growing.push_back(bud);
  }
  for (const std::size_t most : {1, 100, 5000}) {
    ShootPlanner planner(plant, vigour, {}, 1);
    std::vector<std::uint32_t> found;
    for (auto shoots = planner.next(most); !shoots.empty(); shoots = planner.next(most)) {
      CHECK(shoots.size() <= most);
      for (const Shoot& shoot : shoots) found.push_back(shoot.bud);
    }
    CHECK(found == growing);
  }
}
