#include "pathplan/refined_crown.h"

#include <map>

#include "tests/catch.h"
#include "tests/pathplan/graphs.h"

using namespace ramify;
using namespace ramify::pathplan;
using namespace ramify::test;

namespace {

struct Case {
  Place place;
  Refinement refine;
};

/// With trunks, upright and tilted, and without.
std::vector<Case> cases() {
  const std::vector<Place> all = places();
  return {{all[1], {.spheres = 1, .radius = 1.0}},  {all[1], {.spheres = 4, .radius = 0.9}},
          {all[1], {.spheres = 10, .radius = 0.6}}, {all[2], {.spheres = 5, .radius = 0.9}},
          {all[0], {.spheres = 5, .radius = 0.6}},  {all[6], {.spheres = 6, .radius = 0.5}},
          {all[3], {.spheres = 4, .radius = 0.5}}};
}

Parameters parameters_of(const Case& c, std::uint64_t seed = 1) {
  Parameters parameters;
  parameters.seed = seed;
  parameters.root = c.place.root;
  parameters.refine = c.refine;
  Level& level = parameters.levels.front();
  level.volume = c.place.volume;
  level.nodes = 2500;
  level.b = 83;
  return parameters;
}

bool has_trunk(const Case& c) {
  return c.place.volume.shape == Shape::union_of;
}

/// A sphere and its cone, as they stand in the crown's volume.
struct Branch {
  Volume sphere;
  Volume cone;

  double distance_to_axis(const Vec3& point) const {
    return BallAndWall::distance_to_segment(point, cone.center, sphere.center);
  }
};

std::vector<Branch> branches_of(const RefinedCrown& crown, bool has_trunk) {
  const std::vector<Volume>& parts = crown.volume().parts;
  std::vector<Branch> branches;
  for (std::size_t i = has_trunk ? 1 : 0; i + 1 < parts.size(); i += 2) {
    branches.push_back({parts[i], parts[i + 1]});
  }
  return branches;
}

}  // namespace

TEST_CASE("refined crown: the trunk, and so many spheres in the crown with a cone each") {
  for (const Case& c : cases()) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      const Parameters parameters = parameters_of(c, seed);
      const Level& level = parameters.levels.front();
      INFO(c.place.name << ", " << c.refine.spheres << " spheres, seed " << seed);
      const RefinedCrown crown(level, c.refine, c.place.root, seed);
      const std::vector<Branch> branches = branches_of(crown, has_trunk(c));
      REQUIRE(crown.sphere_count() == static_cast<std::size_t>(c.refine.spheres));
      REQUIRE(branches.size() == crown.sphere_count());
      CHECK(crown.volume().parts.size() == 2 * branches.size() + (has_trunk(c) ? 1 : 0));
      const Volume region = endpoint_region(level);
      const double apart = 0.6 * std::cbrt(volume_of(region) / (c.refine.spheres + 1));
      for (std::size_t i = 0; i < branches.size(); ++i) {
        const auto& [sphere, cone] = branches[i];
        CHECK(sphere.radius == c.refine.radius);
        CHECK(contains(region, sphere.center));
        for (std::size_t j = 0; j < i; ++j) {
          CHECK(glm::distance(sphere.center, branches[j].sphere.center) > apart);
        }
        // The cone leads from where it starts to the middle of its sphere and is as wide there.
        REQUIRE(cone.points.size() == 2);
        const Vec3 end = cone.center + glm::normalize(cone.direction) * cone.points[1].y;
        CHECK(glm::distance(end, sphere.center) < 1e-9);
        CHECK(cone.points[1].x == std::max(sphere.radius, cone.points[0].x));
        CHECK(cone.points[0].y == 0.0);
      }
    }
  }
}

TEST_CASE("refined crown: a cone starts at least two spacings wide, or it would cut its sphere off") {
  for (const Case& c : cases()) {
    for (const int nodes : {300, 4000, 50'000}) {
      Parameters parameters = parameters_of(c);
      Level& level = parameters.levels.front();
      level.nodes = nodes;
      INFO(c.place.name << ", " << c.refine.spheres << " spheres, " << nodes << " nodes");
      const RefinedCrown crown(level, c.refine, c.place.root, 1);
      const double spacing = wanted_spacing({.nodes = nodes}, volume_of(crown.volume()));
      for (const Branch& branch : branches_of(crown, has_trunk(c))) {
        CHECK(branch.cone.points[0].x >= 2.0 * spacing * 0.999);
        CHECK(branch.cone.points[0].x < 4.0 * spacing);
      }
    }
  }
}

TEST_CASE(
    "refined crown: a cone leaves an upright trunk at 45 degrees, on its upper part, else at the root") {
  const Case upright = cases()[2];
  const Volume& trunk = upright.place.volume.parts.front();
  const Parameters parameters = parameters_of(upright);
  const RefinedCrown crown(parameters.levels.front(), upright.refine, upright.place.root, 1);
  bool is_one_aslant = false;
  for (const auto& [sphere, cone] : branches_of(crown, true)) {
    const double across = std::max(upright.refine.radius, std::hypot(sphere.center.x, sphere.center.z));
    const double wanted = sphere.center.y - across;
    CHECK(std::hypot(cone.center.x, cone.center.z) < 1e-12);
    CHECK(std::abs(cone.center.y - std::clamp(wanted, 0.4 * trunk.height, trunk.height)) < 1e-9);
    is_one_aslant |= wanted > 0.4 * trunk.height && wanted < trunk.height && across > upright.refine.radius;
  }
  CHECK(is_one_aslant);
  const Case bare = cases()[4];
  const Parameters without = parameters_of(bare);
  for (const Branch& branch :
       branches_of(RefinedCrown(without.levels.front(), bare.refine, bare.place.root, 1), false)) {
    CHECK(branch.cone.center == bare.place.root);
  }
}

TEST_CASE(
    "refined crown: a point in several subvolumes is the trunk's, or the root's, else that of the nearest "
    "axis") {
  for (const Case& c : cases()) {
    const Parameters parameters = parameters_of(c);
    const RefinedCrown crown(parameters.levels.front(), c.refine, c.place.root, 1);
    const std::vector<Branch> branches = branches_of(crown, has_trunk(c));
    const Solid whole(crown.volume());
    const Box box = bounds(crown.volume());
    Rng rng = Rng::stream(1, Stream::dart, 0);
    int shared = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3 point = box.low + box.size() * Vec3(rng.uniform(), rng.uniform(), rng.uniform());
      if (!whole.contains(point)) continue;
      std::vector<std::pair<double, std::uint32_t>> candidates;
      for (std::uint32_t j = 0; j < branches.size(); ++j) {
        if (!contains(branches[j].sphere, point) && !contains(branches[j].cone, point)) continue;
        candidates.emplace_back(branches[j].distance_to_axis(point), j + 1);
        const bool is_in_ball = glm::distance(point, branches[j].sphere.center) <= branches[j].sphere.radius;
        CHECK(crown.is_in_sphere(point, j + 1) == is_in_ball);
      }
      shared += candidates.size() > 1 ? 1 : 0;
      // Without a trunk it is where all cones begin.
      const bool is_in_trunk = has_trunk(c)
                                   ? contains(c.place.volume.parts.front(), point)
                                   : glm::distance(point, c.place.root) <= branches.front().cone.points[0].x;
      REQUIRE((is_in_trunk || !candidates.empty()));
      const std::uint32_t expected =
          is_in_trunk ? 0 : std::min_element(candidates.begin(), candidates.end())->second;
      REQUIRE(crown.subvolume_of(point) == expected);
    }
    if (c.refine.spheres > 1) CHECK(shared > 0);
  }
}

TEST_CASE("refined crown: no edge joins two spheres' nodes, and each sphere has its share of the endpoints") {
  for (const Case& c : cases()) {
    for (const std::uint64_t seed : {1, 2}) {
      for (const EndpointKind kind : {EndpointKind::region, EndpointKind::random, EndpointKind::shell}) {
        INFO(c.place.name << ", " << c.refine.spheres << " spheres, seed " << seed << ", kind "
                          << static_cast<int>(kind));
        Parameters parameters = parameters_of(c, seed);
        Level& level = parameters.levels.front();
        level.endpoints = kind;
        level.shell_thickness = 2.5;
        if (kind == EndpointKind::shell) level.b = 2 * c.refine.spheres + 1;
        CHECK(Engine::check(parameters).empty());
        const RunResult result = run_with_layers(parameters);
        CHECK(violations(result.skeleton).empty());
        CHECK(reported(result, "graph", "unreachable") == 0.0);

        const auto& graph = layer<LineLayer>(result, "graph");
        const auto spheres = static_cast<std::size_t>(c.refine.spheres);
        std::vector<bool> is_joined_to_trunk(spheres + 1, false);
        for (const auto& [a, b] : graph.lines) {
          const auto one = static_cast<std::size_t>(graph.point_values[a]);
          const auto other = static_cast<std::size_t>(graph.point_values[b]);
          REQUIRE((one == other || one == 0 || other == 0));
          if (one == 0) is_joined_to_trunk[other] = true;
          if (other == 0) is_joined_to_trunk[one] = true;
        }
        for (std::size_t i = 1; i <= spheres; ++i) CHECK(is_joined_to_trunk[i]);

        std::map<std::array<double, 3>, std::size_t> subvolume;
        for (std::size_t i = 0; i < graph.points.size(); ++i) {
          const Vec3& p = graph.points[i];
          subvolume[{p.x, p.y, p.z}] = static_cast<std::size_t>(graph.point_values[i]);
        }
        const RefinedCrown crown(level, c.refine, c.place.root, seed);
        std::vector<std::size_t> share(spheres + 1, 0);
        for (const Vec3& p : layer<PointLayer>(result, "endpoints").points) {
          const std::size_t where = subvolume.at({p.x, p.y, p.z});
          ++share[where];
          REQUIRE(where > 0);
          CHECK(crown.is_in_sphere(p, static_cast<std::uint32_t>(where)));
        }
        const auto b = static_cast<std::size_t>(level.b);
        for (std::size_t i = 0; i < spheres; ++i) {
          CHECK(share[i + 1] == b / spheres + (i < b % spheres ? 1 : 0));
        }
      }
    }
  }
}
