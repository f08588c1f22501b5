#include "pathplan/endpoints.h"

#include <set>

#include "common/base/errors.h"
#include "pathplan/poisson_disc.h"
#include "tests/catch.h"

using namespace ramify;
using namespace ramify::pathplan;

namespace {

Level level_of(EndpointKind kind, int b) {
  Level level;
  level.endpoints = kind;
  level.b = b;
  return level;
}

std::vector<Vec3> nodes_of(const Level& level, int count) {
  return scatter_nodes(level.volume, Vec3(0.0), {.nodes = count}).position;
}

/// As the engine asks for them at level 1.
std::vector<std::uint32_t> choose(std::span<const Vec3> nodes, const Level& level, std::uint64_t seed) {
  const Solid region(endpoint_region(level));
  return choose_endpoints({.nodes = nodes, .region = &region}, {.kind = level.endpoints,
                                                                .b = level.b,
                                                                .shell_thickness = level.shell_thickness,
                                                                .points = level.points,
                                                                .seed = seed});
}

std::string error_of(std::span<const Vec3> nodes, const Level& level) {
  try {
    choose(nodes, level, 1);
  } catch (const RunError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("endpoints: b distinct nodes where their kind allows them, never the root") {
  const std::vector<Vec3> nodes = nodes_of({}, 6000);
  for (const EndpointKind kind : {EndpointKind::random, EndpointKind::region, EndpointKind::shell}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      const Level level = level_of(kind, 300);
      const std::vector<std::uint32_t> endpoints = choose(nodes, level, seed);
      CHECK(endpoints.size() == 300);
      CHECK(std::set<std::uint32_t>(endpoints.begin(), endpoints.end()).size() == 300);
      const Volume& crown = level.volume.parts[1];
      for (const std::uint32_t node : endpoints) {
        REQUIRE(node > 0);
        REQUIRE(node < nodes.size());
        if (kind != EndpointKind::random) REQUIRE(contains(crown, nodes[node]));
        if (kind == EndpointKind::shell) {
          REQUIRE(crown.radius - glm::distance(nodes[node], crown.center) <= level.shell_thickness);
        }
      }
    }
  }
}

TEST_CASE("endpoints: a region of one's own takes the crown's place") {
  const std::vector<Vec3> nodes = nodes_of({}, 6000);
  Level level = level_of(EndpointKind::region, 20);
  level.region = {.shape = Shape::sphere, .center = {2.0, 6.0, 0.0}, .radius = 1.0};
  for (const std::uint32_t node : choose(nodes, level, 1)) CHECK(contains(level.region, nodes[node]));
}

TEST_CASE("endpoints: the crown is all parts but the first, or the only one") {
  Level level;
  level.volume.parts.push_back({.shape = Shape::sphere, .center = {0.0, 12.0, 0.0}});
  CHECK(contains(endpoint_region(level), {0.0, 12.5, 0.0}));
  CHECK(contains(endpoint_region(level), {0.0, 9.0, 0.0}));
  CHECK_FALSE(contains(endpoint_region(level), {0.0, 1.0, 0.0}));
  level.volume = {.shape = Shape::cone, .height = 4.0};
  CHECK(contains(endpoint_region(level), {0.0, 1.0, 0.0}));
}

TEST_CASE("endpoints: every node is as likely as every other") {
  const std::vector<Vec3> nodes = nodes_of({}, 31);
  std::vector<int> chosen(nodes.size(), 0);
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    for (const std::uint32_t node : choose(nodes, level_of(EndpointKind::random, 5), seed)) {
      ++chosen[node];
    }
  }
  CHECK(chosen[0] == 0);
  // 500 each on average, with a standard deviation of 20.
  for (std::size_t node = 1; node < nodes.size(); ++node) CHECK(std::abs(chosen[node] - 500) < 90);
}

TEST_CASE("endpoints: all nodes but the root may be asked for, one more is an error that counts them") {
  const std::vector<Vec3> nodes = nodes_of({}, 50);
  CHECK(choose(nodes, level_of(EndpointKind::random, 49), 1).size() == 49);
  CHECK(error_of(nodes, level_of(EndpointKind::random, 50)) ==
        "b: 50 endpoints wanted, 49 nodes beside the root (more nodes, fewer endpoints or a larger place)");

  Level level = level_of(EndpointKind::region, 49);
  level.region = {.shape = Shape::sphere, .center = {0.0, 1.0, 0.0}, .radius = 0.01};
  CHECK(error_of(nodes, level) ==
        "b: 49 endpoints wanted, 0 nodes in the region (more nodes, fewer endpoints or a larger place)");
  level = level_of(EndpointKind::shell, 49);
  level.shell_thickness = 1e-6;
  CHECK(error_of(nodes, level) ==
        "b: 49 endpoints wanted, 0 nodes in the shell of 1e-06 m (more nodes, fewer endpoints or a larger "
        "place)");
}
