#include "growth/phyllotaxis.h"

#include <set>

#include "tests/catch.h"

using namespace ramify;
using namespace ramify::growth;

namespace {

std::vector<Vec3> buds(const TreeParameters& tree, const Frame& frame, std::uint32_t rank,
                       std::uint64_t seed = 1) {
  std::vector<Vec3f> directions(buds_per_node(tree));
  place_buds(tree, seed, BudAngles(tree, 1), frame, 3, rank, directions);
  return {directions.begin(), directions.end()};
}

double angle_between(const Vec3& a, const Vec3& b) {
  return degrees(std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0, 1.0)));
}

/// Degrees about the frame's direction, 0 to 360.
double azimuth(const Vec3& bud, const Frame& frame) {
  const double y = glm::dot(bud, glm::cross(frame.direction, frame.reference));
  const double angle = degrees(std::atan2(y, glm::dot(bud, frame.reference)));
  return angle < 0.0 ? angle + 360.0 : angle;
}

Frame slanted() {
  const Vec3 direction = glm::normalize(Vec3(1, 2, 3));
  return {direction, any_perpendicular(direction)};
}

}  // namespace

TEST_CASE("phyllotaxis: buds stand at the branching angle, at the azimuths that their pattern has") {
  struct Pattern {
    Phyllotaxis kind;
    std::vector<double> first;  // of the node of rank 0
    double turn;                // from a node to the next
  };
  const std::vector<Pattern> patterns = {{Phyllotaxis::spiral, {0}, 137.5},
                                         {Phyllotaxis::alternate, {0}, 180},
                                         {Phyllotaxis::opposite, {0, 180}, 90},
                                         {Phyllotaxis::whorled, {0, 72, 144, 216, 288}, 36}};
  TreeParameters tree;
  tree.branching_angle_deg = 50.0;
  tree.whorl_buds = 5;
  const Frame frame = slanted();
  for (const Pattern& pattern : patterns) {
    tree.phyllotaxis = pattern.kind;
    for (std::uint32_t rank = 0; rank < 80; ++rank) {
      const std::vector<Vec3> found = buds(tree, frame, rank);
      REQUIRE(found.size() == pattern.first.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        CHECK(std::abs(glm::length(found[i]) - 1.0) < 1e-6);
        CHECK(std::abs(angle_between(found[i], frame.direction) - 50.0) < 1e-4);
        const double expected = std::fmod(pattern.first[i] + pattern.turn * rank, 360.0);
        const double off = std::abs(azimuth(found[i], frame) - expected);
        CHECK(std::min(off, 360.0 - off) < 1e-3);
      }
    }
  }
}

TEST_CASE("phyllotaxis: the divergence of a spiral can be chosen") {
  TreeParameters tree;
  tree.divergence_deg = 99.5;
  const Frame frame = slanted();
  CHECK(std::abs(azimuth(buds(tree, frame, 2)[0], frame) - 199.0) < 1e-3);
}

TEST_CASE("phyllotaxis: planar buds fall left and right of their axis equally often") {
  TreeParameters tree;
  tree.phyllotaxis = Phyllotaxis::planar_random;
  tree.branching_angle_deg = 45.0;
  int left = 0;
  for (std::uint32_t rank = 0; rank < 1000; ++rank) {
    const Vec3 bud = buds(tree, {}, rank)[0];
    CHECK(bud.z == 0.0);
    CHECK(std::abs(bud.y - std::sqrt(0.5)) < 1e-6);
    left += bud.x < 0;
  }
  CHECK(std::abs(left - 500) < 80);  // 5 standard deviations
  const Frame along_z{{0, 0, 1}, {1, 0, 0}};
  CHECK(std::abs(buds(tree, along_z, 0)[0].z - std::sqrt(0.5)) < 1e-6);
}

TEST_CASE("phyllotaxis: jitter strays both ways by up to its angle, the same for the same bud") {
  for (const Phyllotaxis kind : {Phyllotaxis::spiral, Phyllotaxis::alternate, Phyllotaxis::opposite,
                                 Phyllotaxis::whorled, Phyllotaxis::planar_random}) {
    TreeParameters straight;
    straight.phyllotaxis = kind;
    TreeParameters strayed = straight;
    strayed.jitter_deg = 10.0;
    const Frame frame = kind == Phyllotaxis::planar_random ? Frame{} : slanted();
    double least = 0.0, most = 0.0;
    for (std::uint32_t rank = 0; rank < 200; ++rank) {
      const std::vector<Vec3> found = buds(strayed, frame, rank);
      CHECK(found == buds(strayed, frame, rank));
      CHECK(found != buds(strayed, frame, rank, 2));
      for (const Vec3& bud : found) {
        const double off = angle_between(bud, frame.direction) - 60.0;
        least = std::min(least, off);
        most = std::max(most, off);
      }
    }
    CHECK(least < -8.0);
    CHECK(least > -10.001);
    CHECK(most > 8.0);
    CHECK(most < 10.001);
  }
}
