// What would be seen from near: tips, the joints of bends.
#include <algorithm>

#include "common/mesh/mesher.h"
#include "common/skeleton/passes.h"
#include "tests/catch.h"
#include "tests/common/trees.h"

using namespace ramify;
using namespace ramify::test;

namespace {

/// How far the mesh goes from a point in a direction, a unit vector: to the last triangle that the ray meets.
double reach(const Mesh& mesh, const Vec3& from, const Vec3& direction) {
  double farthest = 0.0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 a(mesh.positions[i]);
    const Vec3 ab = Vec3(mesh.positions[j]) - a;
    const Vec3 ac = Vec3(mesh.positions[k]) - a;
    const Vec3 across = glm::cross(direction, ac);
    const double determinant = glm::dot(ab, across);
    if (std::abs(determinant) < 1e-15) continue;
    const double u = glm::dot(from - a, across) / determinant;
    const Vec3 other = glm::cross(from - a, ab);
    const double v = glm::dot(direction, other) / determinant;
    if (u < -1e-6 || v < -1e-6 || u + v > 1.0 + 1e-6) continue;
    farthest = std::max(farthest, glm::dot(ac, other) / determinant);
  }
  return farthest;
}

/// 1 m up and 1 m on in another direction, 0.2 m thick.
Skeleton elbow(double turn_deg) {
  Skeleton s;
  add_node(s, {0, 0, 0}, kNoParent, 0.2);
  add_node(s, {0, 1, 0}, 0, 0.2);
  add_node(s, {std::sin(radians(turn_deg)), 1 + std::cos(radians(turn_deg)), 0}, 1, 0.2);
  s.axis = {0, 0, 0};
  return s;
}

}  // namespace

TEST_CASE("close-ups: between the cones of a bend no notch is left open") {
  for (const int sides : {3, 4, 5, 8, 12}) {
    for (const double turn_deg : {10.0, 30.0, 60.0, 90.0, 120.0, 150.0}) {
      const MesherOptions options{.method = MeshMethod::cones, .sides_min = sides, .sides_max = sides};
      const Mesh mesh = build_mesh(elbow(turn_deg), options);
      INFO(sides << " sides, " << turn_deg << " degrees");
      // On the outer side, from square to the one cone to square to the other.
      for (double share = 0.0; share <= 1.0; share += 0.05) {
        const double angle = radians(180.0 - share * turn_deg);
        for (const double aside : {0.0, 0.3, -0.3}) {
          const Vec3 outwards = glm::normalize(Vec3(std::cos(angle), std::sin(angle), aside));
          CHECK(reach(mesh, {0, 1, 0}, outwards) > 0.1 * std::cos(std::numbers::pi / sides) * 0.93);
        }
      }
    }
  }
}

TEST_CASE("close-ups: the tips of cones are round, those of twigs of few sides too") {
  for (const int sides : {3, 4, 6, 8, 12}) {
    const Mesh mesh =
        build_mesh(pole(1), {.method = MeshMethod::cones, .sides_min = sides, .sides_max = sides});
    // Seen from a side, their outline is near a circle's.
    Vec3f corner(0.0f);
    for (const Vec3f& p : mesh.positions) {
      if (std::abs(p.y - 1.0f) < 1e-5f && p.x * p.x + p.z * p.z > 1e-4f) corner = p;
    }
    REQUIRE(corner != Vec3f(0.0f));
    const Vec3f outwards = glm::normalize(Vec3f(corner.x, 0, corner.z));
    for (double angle_deg = 0.0; angle_deg <= 90.0; angle_deg += 7.5) {
      const double angle = radians(angle_deg);
      float farthest = 0.0f;
      for (const Vec3f& p : mesh.positions) {
        const Vec3f from = p - Vec3f(0, 1, 0);
        if (from.y < -1e-5f) continue;
        farthest = std::max(farthest, glm::dot(from, outwards) * static_cast<float>(std::cos(angle)) +
                                          from.y * static_cast<float>(std::sin(angle)));
      }
      INFO(sides << " sides, " << angle_deg << " degrees");
      CHECK(farthest > 0.05f * (sides < 5 ? 0.92f : 0.96f));
    }
  }
}
