// What would be seen from near: tips, the joints of bends, what lies on the ground.
#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "common/mesh/mesher.h"
#include "common/skeleton/passes.h"
#include "tests/catch.h"
#include "tests/common/trees.h"

using namespace ramify;
using namespace ramify::test;

namespace {

/// Where a ray meets a triangle: how far from its start, and the shares of the second and third corner.
struct Hit {
  double distance = 0.0;
  double second = 0.0;
  double third = 0.0;
};

/// The last triangle that a ray meets, in a direction, a unit vector; none: nullopt.
std::optional<std::pair<Triangle, Hit>> last_hit(const Mesh& mesh, const Vec3& from, const Vec3& direction) {
  std::optional<std::pair<Triangle, Hit>> last;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 a(mesh.positions[i]);
    const Vec3 ab = Vec3(mesh.positions[j]) - a;
    const Vec3 ac = Vec3(mesh.positions[k]) - a;
    const Vec3 across = glm::cross(direction, ac);
    const double determinant = glm::dot(ab, across);
    if (std::abs(determinant) < 1e-15) continue;
    const Vec3 other = glm::cross(from - a, ab);
    const Hit hit{glm::dot(ac, other) / determinant, glm::dot(from - a, across) / determinant,
                  glm::dot(direction, other) / determinant};
    if (hit.second < -1e-6 || hit.third < -1e-6 || hit.second + hit.third > 1.0 + 1e-6) continue;
    if (hit.distance > (last ? last->second.distance : 0.0)) last = {{i, j, k}, hit};
  }
  return last;
}

/// What vertices have, where a ray meets the mesh.
template <class T>
T mixed_at(const BulkVector<T>& of_vertices, const std::pair<Triangle, Hit>& where) {
  const auto& [triangle, hit] = where;
  const auto second = static_cast<float>(hit.second);
  const auto third = static_cast<float>(hit.third);
  return of_vertices[triangle[0]] * (1.0f - second - third) + of_vertices[triangle[1]] * second +
         of_vertices[triangle[2]] * third;
}

/// How far the mesh goes from a point in a direction, a unit vector.
double reach(const Mesh& mesh, const Vec3& from, const Vec3& direction) {
  const auto last = last_hit(mesh, from, direction);
  return last ? last->second.distance : 0.0;
}

float lowest(const Mesh& mesh) {
  float low = std::numeric_limits<float>::infinity();
  for (const Vec3f& p : mesh.positions) low = std::min(low, p.y);
  return low;
}

std::size_t flipped_triangles(const Mesh& mesh) {
  std::size_t flipped = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3f& a = mesh.positions[i];
    const Vec3f across = glm::cross(mesh.positions[j] - a, mesh.positions[k] - a);
    flipped += glm::dot(mesh.normals[i] + mesh.normals[j] + mesh.normals[k], across) <= 0;
  }
  return flipped;
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

TEST_CASE("close-ups: tubes end in tips as long as half their width, those of three sides too") {
  for (const int sides : {3, 4, 6, 12}) {
    const Mesh mesh = build_mesh(pole(1), {.sides_min = sides, .sides_max = sides});
    float highest = 0.0f;
    for (const Vec3f& p : mesh.positions) highest = std::max(highest, p.y);
    CHECK(highest == Approx(1.05f));
  }
}

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

TEST_CASE("close-ups: cones of other tapers meet without a step, in outline, bark and shading") {
  // The third internode tapers more, or less, than those beside it.
  for (const std::array<double, 5>& radii :
       {std::array{0.2, 0.19, 0.18, 0.1, 0.09}, {0.2, 0.12, 0.1, 0.1, 0.1}, {0.1, 0.1, 0.12, 0.19, 0.19}}) {
    Skeleton s;
    for (std::uint32_t i = 0; i < 5; ++i)
      add_node(s, {0, 0.3 * i, 0}, i == 0 ? kNoParent : i - 1, 2.0 * radii[i]);
    assign_axes(s);
    const Mesh mesh = build_mesh(s, {.method = MeshMethod::cones});
    constexpr double step = 0.002;
    const Vec3 outwards = glm::normalize(Vec3(0.9, 0.0, 0.2));
    std::optional<double> before;
    std::optional<double> v_before;
    Vec3f normal_before(0.0f);
    for (double height = 0.101; height < 1.1; height += step) {  // beside the nodes, where spheres touch
      const auto hit = last_hit(mesh, {0, height, 0}, outwards);
      REQUIRE(hit);
      const Hit& at = hit->second;
      const double v = mixed_at(mesh.uvs, *hit).y;
      const Vec3f normal = glm::normalize(mixed_at(mesh.normals, *hit));
      INFO(radii[2] << " m, at " << height << " m");
      if (before) {
        CHECK(std::abs(normal.y - normal_before.y) < 0.02f);
        CHECK(std::abs(at.distance - *before) < 0.4 * step);
        CHECK(v > *v_before);
        CHECK(v - *v_before < 2.0 * step / (2.0 * std::numbers::pi * at.distance));
      }
      before = at.distance;
      v_before = v;
      normal_before = normal;
    }
  }
}

TEST_CASE("close-ups: cones that meet in the edge of a bend have the same shading there") {
  const double turn = radians(47.0);
  const Vec3 bend(std::sin(0.5 * turn), std::cos(0.5 * turn), 0);  // square to the plane of the edge
  const Vec3 inwards(std::cos(0.5 * turn), -std::sin(0.5 * turn), 0);
  // Near: internodes so short that there are rings about the edge. Else normals turn over the whole cone.
  for (const double length : {0.1, 1.0}) {
    Skeleton s;
    for (std::uint32_t i = 0; i <= 8; ++i) {
      const double from = (static_cast<double>(i) - 4.0) * length;
      const Vec3 along = from < 0.0 ? kUp : Vec3(std::sin(turn), std::cos(turn), 0);
      add_node(s, from * along, i == 0 ? kNoParent : i - 1, 0.3);
    }
    s.axis.assign(9, 0);
    const Mesh mesh = build_mesh(s, {.method = MeshMethod::cones});
    for (const double aside : {-0.9, -0.4, 0.0, 0.5, 1.0}) {
      const Vec3 direction = inwards * std::cos(aside) + Vec3(0, 0, 1) * std::sin(aside);
      INFO(length << " m, " << aside);
      float before = 0.0f;
      float jump = 0.0f;
      for (double from_edge = -0.05; from_edge <= 0.05; from_edge += 0.002) {
        const auto hit = last_hit(mesh, from_edge * bend, direction);
        REQUIRE(hit);
        const float along = glm::dot(glm::normalize(mixed_at(mesh.normals, *hit)), Vec3f(bend));
        if (from_edge > -0.05) jump = std::max(jump, std::abs(along - before));
        before = along;
      }
      CHECK(jump < 0.06f);
    }
  }
}

TEST_CASE("close-ups: by cones nothing stands out of a bend, and bark and shading run on through it") {
  for (const int sides : {3, 5, 12}) {
    for (const double turn_deg : {15.0, 35.0, 55.0}) {
      for (const double end : {0.08, 0.1}) {  // metres thick
        const double turn = radians(turn_deg);
        const Vec3 bend(std::sin(0.5 * turn), std::cos(0.5 * turn), 0);
        const Vec3 inwards(std::cos(0.5 * turn), -std::sin(0.5 * turn), 0);
        Skeleton s;
        add_node(s, {0, -1, 0}, kNoParent, 0.1);
        add_node(s, {0, 0, 0}, 0, 0.1);
        add_node(s, {std::sin(turn), std::cos(turn), 0}, 1, end);
        s.axis = {0, 0, 0};
        const Mesh mesh =
            build_mesh(s, {.method = MeshMethod::cones, .sides_min = sides, .sides_max = sides});
        CHECK(flipped_triangles(mesh) == 0);
        for (double aside = 0.1; aside < 2.0 * std::numbers::pi; aside += 0.3) {
          INFO(sides << " sides, " << turn_deg << " degrees, " << end << " m, " << aside);
          const Vec3 direction = inwards * std::cos(aside) + Vec3(0, 0, 1) * std::sin(aside);
          constexpr double step = 0.002;
          std::optional<std::pair<Triangle, Hit>> before;
          for (double from_edge = -0.04; from_edge <= 0.04; from_edge += step) {
            const auto hit = last_hit(mesh, from_edge * bend, direction);
            REQUIRE(hit);
            if (before) {
              const Vec3f turned = mixed_at(mesh.normals, *hit) - mixed_at(mesh.normals, *before);
              CHECK(std::abs(glm::dot(turned, Vec3f(bend))) < 0.03f);
              CHECK(std::abs(hit->second.distance - before->second.distance) < 1.4 * step);
              CHECK(std::abs(mixed_at(mesh.uvs, *hit).y - mixed_at(mesh.uvs, *before).y) <
                    3.0 * step / (0.1 * 3.14));
            }
            before = hit;
          }
        }
      }
    }
  }
}

TEST_CASE("close-ups: where thick wood tapers much, bark is as wide on all of a side") {
  const std::array methods = {MesherOptions{}, MesherOptions{.centre_line = CentreLine::catmull_rom},
                              MesherOptions{.method = MeshMethod::cones}};
  for (std::size_t method = 0; method < methods.size(); ++method) {
    for (const double lean : {0.0, 0.4}) {
      Skeleton s;
      for (std::uint32_t i = 0; i < 6; ++i) {
        const double diameter = i < 3 ? 0.6 : 0.1;
        add_node(s, {0, 1.0 * i, i > 2 ? lean * (i - 2) : 0.0}, i == 0 ? kNoParent : i - 1, diameter);
      }
      s.axis.assign(6, 0);
      const Mesh mesh = build_mesh(s, methods[method]);
      const Vec3 from(0, 2, 0);
      const Vec3 along = glm::normalize(Vec3(0, 1, lean));
      double widest = 0.0;  // girths; once around should be one
      double narrowest = 10.0;
      std::size_t count = 0;
      for (const Triangle& corners : mesh.triangles) {
        const auto position = [&](std::size_t i) { return Vec3(mesh.positions[corners[i]]); };
        const auto u = [&](std::size_t i) { return double{mesh.uvs[corners[i]].x}; };
        const Vec3 middle = (position(0) + position(1) + position(2)) / 3.0;
        if (middle.y < 2.32 || middle.y > 2.7) continue;  // beyond the sphere
        const Vec3 first = position(1) - position(0);
        const Vec3 second = position(2) - position(0);
        const Vec3 area = glm::cross(first, second);
        const Vec3 change = glm::cross(area, second * (u(1) - u(0)) - first * (u(2) - u(0)));
        const double radius = glm::length(glm::cross(middle - from, along));
        const double around = 2.0 * std::numbers::pi * radius * glm::length(change) / glm::dot(area, area);
        widest = std::max(widest, around);
        narrowest = std::min(narrowest, around);
        ++count;
      }
      INFO("method " << method << ", leaning by " << lean);
      CHECK(count > 20);
      CHECK(widest < 1.35);
      CHECK(narrowest > 0.7);
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

TEST_CASE(
    "close-ups: wood near the ground is flat below, by cones and by tubes, what grows down is not cut") {
  for (const MeshMethod method : {MeshMethod::smooth, MeshMethod::cones}) {
    for (const double radius : {0.005, 0.02, 0.1}) {
      Skeleton s = pole(3);
      add_node(s, {0.4, 0.01, 0}, 0, 2.0 * radius);  // a lateral at the root that lies
      add_node(s, {0.8, 0.0, 0.1}, 4, 2.0 * radius);
      s.position[1].y = 0.05;  // half as high as it is thick
      s.axis = {0, 0, 0, 0, 1, 1};
      const Mesh mesh = build_mesh(s, {.method = method});
      INFO((method == MeshMethod::cones ? "cones, " : "smooth, ") << radius << " m");
      CHECK(lowest(mesh) >= 0.0f);
      CHECK(flipped_triangles(mesh) == 0);
      s.position[5].y = -0.3;
      CHECK(lowest(build_mesh(s, {.method = method})) < -0.29f);
    }
  }
}

TEST_CASE("close-ups: by cones the foot of a trunk that leans has no notch where it stands on the ground") {
  for (const double lean_deg : {10.0, 20.0, 33.0}) {
    const double lean = radians(lean_deg);
    Skeleton s;
    add_node(s, {0, 0, 0}, kNoParent, 0.6);
    add_node(s, 0.15 * Vec3(std::sin(lean), std::cos(lean), 0), 0, 0.6);
    add_node(s, s.position[1] + 0.3 * kUp, 1, 0.6);
    s.axis.assign(3, 0);
    const Mesh mesh = build_mesh(s, {.method = MeshMethod::cones});
    CHECK(flipped_triangles(mesh) == 0);
    for (double angle = 0.0; angle < 2.0 * std::numbers::pi; angle += 0.05) {
      const Vec3 from(0, 0.004, 0);
      const Vec3 outwards(std::cos(angle), 0, std::sin(angle));
      double farthest = 0.0;  // in the wood
      for (double along = 0.2; along < 0.6; along += 0.001) {
        const Vec3 p = from + along * outwards;
        for (std::uint32_t node = 1; node < 3; ++node) {
          const Vec3 base = s.position[node - 1];
          const Vec3 step = s.position[node] - base;
          const double share = std::clamp(glm::dot(p - base, step) / glm::dot(step, step), 0.0, 1.0);
          if (glm::distance(p, base + share * step) < 0.3) farthest = along;
        }
      }
      INFO(lean_deg << " degrees, towards " << angle);
      CHECK(reach(mesh, from, outwards) > 0.95 * farthest);
    }
  }
}

TEST_CASE("close-ups: a collar at the end of its parent begins within the parent's tip") {
  const Mesh parent = build_mesh(elbow(0.0), {.root_flare = 0.0});
  for (const double angle_deg : {60.0, 100.0, 125.0, 145.0, 165.0}) {
    for (const double diameter : {0.06, 0.12, 0.135, 0.18}) {
      if (diameter > 0.14 && angle_deg < 120.0) continue;  // goes on as a part of the parent
      Skeleton s = elbow(0.0);
      const Vec3 along(std::sin(radians(angle_deg)), std::cos(radians(angle_deg)), 0);
      add_node(s, Vec3(0, 2, 0) + along, 2, diameter);
      s.axis = {0, 0, 0, 1};
      const Mesh mesh = build_mesh(s, {.root_flare = 0.0});
      INFO(angle_deg << " degrees, " << diameter << " m");
      // The collar's first ring follows upon the parent; a ring ends where u is 1.
      for (std::size_t v = parent.vertex_count(); v < mesh.vertex_count(); ++v) {
        const Vec3 p(mesh.positions[v]);
        const Vec3 from = p - Vec3(0, 2, 0);
        if (from.y > 0.0) CHECK(reach(parent, {0, 2, 0}, glm::normalize(from)) > glm::length(from));
        if (mesh.uvs[v].x == 1.0f) break;
      }
    }
  }
}

TEST_CASE("close-ups: a collar begins within a parent that bends, by either centre line") {
  for (const CentreLine line : {CentreLine::polyline, CentreLine::catmull_rom}) {
    for (const double bend_deg : {20.0, 40.0, 60.0}) {
      for (const double toward_deg : {0.0, 60.0, 120.0, 180.0}) {
        Skeleton s;
        Vec3 along = kUp;
        add_node(s, {0, 0, 0}, kNoParent, 0.2);
        for (std::uint32_t i = 0; i < 6; ++i) {
          // To and fro, so that the curve swings out to both sides.
          const double lean = i % 2 == 0 ? 0.5 * radians(bend_deg) : -0.5 * radians(bend_deg);
          along = Vec3(std::sin(lean), std::cos(lean), 0);
          add_node(s, s.position[i] + along * 0.5, i, 0.2);
        }
        s.axis.assign(7, 0);
        const MesherOptions options{.centre_line = line, .root_flare = 0.0};
        const Mesh parent = build_mesh(s, options);
        const double toward = radians(toward_deg);
        const Vec3 center = s.position[3];
        add_node(s, center + Vec3(std::cos(toward), 0.3, std::sin(toward)), 3, 0.14);
        s.axis.push_back(1);
        const Mesh mesh = build_mesh(s, options);
        INFO((line == CentreLine::polyline ? "polyline, " : "catmull-rom, ")
             << bend_deg << " degrees, towards " << toward_deg);
        std::size_t feet = 0;
        for (std::size_t v = parent.vertex_count(); v < mesh.vertex_count(); ++v, ++feet) {
          const Vec3 from = Vec3(mesh.positions[v]) - center;
          CHECK(reach(parent, center, glm::normalize(from)) > glm::length(from));
          if (mesh.uvs[v].x == 1.0f) break;
        }
        CHECK(feet >= 4);
      }
    }
  }
}

namespace {

/// How far the first ring of the last axis' collar is outside of the mesh without that axis, seen from a
/// place within both, in parts of `radius`. That axis comes last in the mesh; a ring ends where u is 1.
double farthest_outside(const Mesh& bearer, const Mesh& mesh, const Vec3& center, double radius) {
  double farthest = -1.0;
  for (std::size_t v = bearer.vertex_count(); v < mesh.vertex_count(); ++v) {
    const Vec3 from = Vec3(mesh.positions[v]) - center;
    const double inside = reach(bearer, center, glm::normalize(from));
    farthest = std::max(farthest, (glm::length(from) - inside) / radius);
    if (mesh.uvs[v].x == 1.0f) break;
  }
  return farthest;
}

}  // namespace

TEST_CASE("close-ups: a collar begins within a parent that turns sharply between short internodes") {
  const MesherOptions options{.root_flare = 0.0};
  for (const double turn_deg : {60.0, 75.0, 90.0}) {
    const double turn = radians(turn_deg);
    Skeleton s;
    add_node(s, {0, 0, 0}, kNoParent, 0.2);
    add_node(s, {0, 1.0, 0}, 0, 0.2);
    add_node(s, {0, 1.3, 0}, 1, 0.2);
    add_node(s, Vec3(0, 1.3, 0) + Vec3(std::sin(turn), std::cos(turn), 0) * 0.3, 2, 0.2);
    add_node(s, Vec3(0, 1.3, 0) + Vec3(std::sin(turn), std::cos(turn), 0) * 1.3, 3, 0.2);
    s.axis.assign(5, 0);
    const Mesh bearer = build_mesh(s, options);
    // Along the line between both directions, and up to square to it.
    const Vec3 middle = glm::normalize(Vec3(std::sin(turn), 1.0 + std::cos(turn), 0));
    const Vec3 outer = glm::normalize(Vec3(-middle.y, middle.x, 0));
    for (const double lean_deg : {40.0, 65.0, 90.0}) {
      for (const double toward_deg : {0.0, 45.0, 90.0, 135.0, 180.0}) {
        for (const double share : {0.4, 0.7, 0.95}) {
          const double toward = radians(toward_deg);
          const Vec3 aside = outer * std::cos(toward) + Vec3(0, 0, std::sin(toward));
          const Vec3 along = middle * std::cos(radians(lean_deg)) + aside * std::sin(radians(lean_deg));
          Skeleton forked = s;
          add_node(forked, s.position[2] + along, 2, 0.2 * share);
          forked.axis.push_back(1);
          const Mesh mesh = build_mesh(forked, options);
          INFO(turn_deg << " degrees, leans " << lean_deg << " towards " << toward_deg << ", " << share);
          CHECK(farthest_outside(bearer, mesh, s.position[2], 0.1) < 0.01);
          CHECK(flipped_triangles(mesh) <= flipped_triangles(bearer));
        }
      }
    }
  }
}

TEST_CASE(
    "close-ups: a collar begins within a parent whose own base was moved to the middle of a rounded bend") {
  const MesherOptions options{.root_flare = 0.0};
  for (const double turn_deg : {25.0, 40.0, 55.0}) {
    const double turn = radians(turn_deg);
    Skeleton s;
    add_node(s, {0, 0, 0}, kNoParent, 0.4);
    add_node(s, {0, 1.5, 0}, 0, 0.4);
    add_node(s, Vec3(0, 1.5, 0) + Vec3(std::sin(turn), std::cos(turn), 0) * 1.5, 1, 0.4);
    s.axis.assign(3, 0);
    add_node(s, {0.0, 1.6, 0.45}, 1, 0.1);
    add_node(s, {0.0, 1.7, 1.2}, 3, 0.1);
    s.axis.insert(s.axis.end(), {1, 1});
    const Mesh bearer = build_mesh(s, options);
    for (double toward_deg = 0.0; toward_deg < 360.0; toward_deg += 45.0) {
      const double toward = radians(toward_deg);
      Skeleton forked = s;
      add_node(forked, s.position[3] + Vec3(std::cos(toward), std::sin(toward), 0.2) * 0.5, 3, 0.06);
      forked.axis.push_back(2);
      INFO(turn_deg << " degrees, towards " << toward_deg);
      CHECK(farthest_outside(bearer, build_mesh(forked, options), s.position[3], 0.05) < 0.01);
    }
  }
}

TEST_CASE("close-ups: a long row of axes, each on the first internode of the one before, is meshed") {
  Skeleton s;
  add_node(s, {0, 0, 0}, kNoParent, 0.2);
  s.axis = {0};
  constexpr std::uint32_t count = 50000;
  std::uint32_t base = 0;
  for (std::uint32_t i = 1; i <= count; ++i) {
    const double turn = 0.4 * i;
    const Vec3 step(std::cos(turn), 1.0, std::sin(turn));
    const std::uint32_t bearer = base;
    base = static_cast<std::uint32_t>(s.node_count());
    add_node(s, s.position[bearer] + step, bearer, 0.2);
    add_node(s, s.position[base] + Vec3(-step.z, 1.0, step.x), base, 0.2);  // so far round that it is rounded
    s.axis.insert(s.axis.end(), {i, i});
  }
  const Mesh mesh = build_mesh(s, {});
  CHECK(mesh.triangles.size() > 12 * count);
  CHECK(std::all_of(mesh.positions.begin(), mesh.positions.end(), [&](const Vec3f& p) {
    return std::isfinite(p.x + p.y + p.z) && p.y < s.position.back().y + 1.0f;
  }));
}

namespace {

/// Texture coordinates where a ray leaves the mesh.
Vec2f outermost_uv(const Mesh& mesh, const Vec3& from, const Vec3& direction) {
  const auto last = last_hit(mesh, from, direction);
  REQUIRE(last);
  return mixed_at(mesh.uvs, *last);
}

}  // namespace

TEST_CASE("close-ups: by cones bark does not jump on wood that winds in internodes shorter than its radius") {
  for (const double turn_deg : {25.0, 45.0, 65.0}) {
    Skeleton s;
    add_node(s, {0, 0, 0}, kNoParent, 0.5);
    for (std::uint32_t i = 0; i < 8; ++i) {
      // To and fro, and round.
      const double lean = (i % 2 == 0 ? 0.5 : -0.5) * radians(turn_deg);
      const double toward = 0.8 * i;
      const Vec3 aside(std::cos(toward), 0, std::sin(toward));
      add_node(s, s.position[i] + 0.18 * (kUp * std::cos(lean) + aside * std::sin(lean)), i, 0.5);
    }
    s.axis.assign(9, 0);
    const Mesh mesh = build_mesh(s, {.method = MeshMethod::cones});
    double greatest_u = 0.0;
    double greatest_v = 0.0;
    for (double angle = 0.0; angle < 2.0 * std::numbers::pi; angle += 0.3) {
      const Vec3 outwards(std::cos(angle), 0, std::sin(angle));
      constexpr double step = 0.004;
      Vec2f before = outermost_uv(mesh, {0, 0.3, 0}, outwards);
      for (double height = 0.3 + step; height < 1.1; height += step) {
        const Vec2f here = outermost_uv(mesh, {0, height, 0}, outwards);
        const Vec2f apart = here - before;
        before = here;
        // An arc of the girth is as long by v, but where the surface is steep.
        greatest_u = std::max(greatest_u, std::abs(double{apart.x} - std::round(apart.x)));
        greatest_v = std::max(greatest_v, std::abs(apart.y - step / (0.5 * std::numbers::pi)));
      }
    }
    INFO(turn_deg << " degrees");
    CHECK(greatest_u < 0.002);
    CHECK(greatest_v < 0.02);
  }
}
