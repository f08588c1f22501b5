#include "pathplan/near_nodes.h"

#include <algorithm>
#include <map>
#include <utility>

#include "tests/catch.h"
#include "tests/pathplan/graphs.h"

using namespace ramify;
using namespace ramify::pathplan;
using namespace ramify::test;

namespace {

/// Nodes of a volume, far from the origin too, where single precision is coarse.
std::vector<Vec3> nodes_at(const Place& place, double shift) {
  std::vector<Vec3> nodes = scatter_nodes(place.volume, place.root, {.nodes = 400}, 4).position;
  for (Vec3& node : nodes) node += shift;
  return nodes;
}

}  // namespace

TEST_CASE("near nodes: each pair within reach is met from one of its ends, few others are") {
  for (const Place& place : places()) {
    for (const double shift : {0.0, 1e5}) {
      for (const double reach : {0.1, 0.5, 20.0}) {
        INFO(place.name << ", shift " << shift << ", reach " << reach);
        const std::vector<Vec3> nodes = nodes_at(place, shift);
        const PointGrid grid(nodes, reach);
        const RoundedNodes rounded(nodes, grid);
        NearNodes near(rounded);
        std::set<std::pair<std::uint32_t, std::uint32_t>> met;  // by place
        std::uint32_t place_of_node = 0;
        for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
          near.gather_ahead(cell);
          for (std::size_t i = 0; i < grid.ids_in(cell).size(); ++i, ++place_of_node) {
            for (const std::uint32_t other : near.ahead_of(i, reach)) {
              REQUIRE(other > place_of_node);
              met.insert({place_of_node, other});
            }
          }
        }
        std::size_t near_pairs = 0;
        for (std::uint32_t a = 0; a < nodes.size(); ++a) {
          for (std::uint32_t b = a + 1; b < nodes.size(); ++b) {
            if (glm::distance(nodes[grid.order()[a]], nodes[grid.order()[b]]) > reach) continue;
            ++near_pairs;
            REQUIRE(met.count({a, b}) == 1);
          }
        }
        CHECK(met.size() <= near_pairs + near_pairs / 100);
      }
    }
  }
}

TEST_CASE("near nodes: ways from one to another are off by no more than is told") {
  for (const Place& place : places()) {
    for (const double shift : {0.0, 1e5}) {
      std::vector<Vec3> nodes = nodes_at(place, shift);
      for (std::size_t i = 0; i < nodes.size(); i += 2) nodes[i].x += 1e3 * shift;  // far from the others
      constexpr double kReach = 0.5;
      const PointGrid grid(nodes, kReach);
      const RoundedNodes rounded(nodes, grid);
      INFO(place.name << ", shift " << shift);
      for (std::uint32_t a = 0; a < nodes.size(); ++a) {
        for (std::uint32_t b = 0; b < nodes.size(); ++b) {
          const Vec3 way = nodes[grid.order()[b]] - nodes[grid.order()[a]];
          const Lanes d = rounded.way(a, b);
          for (int axis = 0; axis < 3; ++axis) {
            REQUIRE(std::abs(double{d[static_cast<std::size_t>(axis)]} - way[axis]) <= rounded.way_error());
          }
          const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
          if (glm::length(way) > kReach) continue;
          REQUIRE(std::abs(square - glm::dot(way, way)) <= rounded.square_error(kReach));
        }
      }
      if (shift == 0.0) CHECK(rounded.square_error(kReach) < 1e-4 * kReach * kReach);
    }
  }
}

TEST_CASE("near nodes: all nodes of a box of cells that are within reach of a position are found") {
  for (const Place& place : places()) {
    for (const double shift : {0.0, 1e5}) {
      const std::vector<Vec3> nodes = nodes_at(place, shift);
      const PointGrid grid(nodes, 0.3);
      const RoundedNodes rounded(nodes, grid);
      NearNodes near(rounded);
      for (const double reach : {0.2, 0.7}) {
        const Vec3 position = place.root + shift + Vec3(0.1, 0.6, -0.1);
        const auto found = near.among(grid.touching({position - reach, position + reach}), position, reach);
        for (std::uint32_t i = 0; i < nodes.size(); ++i) {
          const double distance = glm::distance(nodes[grid.order()[i]], position);
          const bool is_found = std::find(found.begin(), found.end(), i) != found.end();
          INFO(place.name << ", shift " << shift << ", reach " << reach << ", place " << i);
          if (distance <= reach) REQUIRE(is_found);
          if (distance > 1.01 * reach) REQUIRE_FALSE(is_found);
        }
      }
    }
  }
}
