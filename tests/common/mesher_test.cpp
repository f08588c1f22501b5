#include "common/mesh/mesher.h"

#include <algorithm>
#include <map>

#include "common/base/parallel.h"
#include "common/config/job.h"
#include "common/mesh/attribute_colors.h"
#include "common/mesh/smooth.h"
#include "common/mesh/tree_mesh.h"
#include "common/mesh/tube_plan.h"
#include "common/skeleton/passes.h"
#include "tests/catch.h"
#include "tests/common/trees.h"
#include "tests/engines.h"

using namespace ramify;
using namespace ramify::test;

namespace {

Skeleton pole_of_width(int internodes, double diameter) {
  Skeleton s = pole(internodes);
  for (double& d : s.diameter) d = diameter;
  return s;
}

/// A binary tree whose internodes are much longer than wide, as on real trees.
Skeleton slim_tree(int depth) {
  Skeleton s = binary_tree(depth);
  for (double& d : s.diameter) d *= 0.1;
  return s;
}

/// Of a point from a triangle, metres.
double distance_to_triangle(const Mesh& mesh, std::size_t t, const Vec3f& point) {
  const auto& [i, j, k] = mesh.triangles[t];
  const Vec3 corners[] = {Vec3(mesh.positions[i]), Vec3(mesh.positions[j]), Vec3(mesh.positions[k])};
  const Vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  bool is_above = true;
  double nearest = 1e9;
  for (std::size_t a = 0; a < 3; ++a) {
    const Vec3 edge = corners[(a + 1) % 3] - corners[a];
    const Vec3 offset = Vec3(point) - corners[a];
    is_above = is_above && glm::dot(glm::cross(edge, offset), normal) >= 0.0;
    const double share = std::clamp(glm::dot(offset, edge) / glm::dot(edge, edge), 0.0, 1.0);
    nearest = std::min(nearest, glm::length(offset - edge * share));
  }
  return is_above ? std::abs(glm::dot(Vec3(point) - corners[0], glm::normalize(normal))) : nearest;
}

Vec3f corner(const Mesh& mesh, std::size_t triangle, std::size_t i) {
  return mesh.positions[mesh.triangles[triangle][i]];
}

Vec3f area_vector(const Mesh& mesh, std::size_t t) {
  return 0.5f * glm::cross(corner(mesh, t, 1) - corner(mesh, t, 0), corner(mesh, t, 2) - corner(mesh, t, 0));
}

/// Enclosed by the triangles, positive if they face outwards.
double volume(const Mesh& mesh) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    sum += glm::dot(Vec3(corner(mesh, t, 0)), Vec3(area_vector(mesh, t))) / 3.0;
  }
  return sum;
}

void check_sound(const Mesh& mesh) {
  REQUIRE(mesh.normals.size() == mesh.vertex_count());
  REQUIRE(mesh.uvs.size() == mesh.vertex_count());
  REQUIRE(mesh.internodes.size() == mesh.vertex_count());
  std::size_t covered = 0;
  for (const MaterialRange& range : mesh.ranges) {
    CHECK(range.first_triangle == covered);
    covered += range.triangle_count;
  }
  CHECK(covered == mesh.triangles.size());

  std::size_t faults = 0;
  for (const Vec3f& normal : mesh.normals) faults += std::abs(glm::length(normal) - 1.0f) > 1e-5f;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t vertex : mesh.triangles[t]) REQUIRE(vertex < mesh.vertex_count());
    faults += !(glm::length(area_vector(mesh, t)) > 0.0f);
  }
  CHECK(faults == 0);
}

/// To the last bit.
void check_same(const Mesh& a, const Mesh& b) {
  CHECK(a.positions == b.positions);
  CHECK(a.normals == b.normals);
  CHECK(a.uvs == b.uvs);
  CHECK(a.tangents == b.tangents);
  CHECK(a.colors == b.colors);
  CHECK(a.internodes == b.internodes);
  CHECK(a.triangles == b.triangles);
  CHECK(a.ranges.size() == b.ranges.size());
  CHECK(a.materials.size() == b.materials.size());
  CHECK(a.warnings == b.warnings);
}

}  // namespace

TEST_CASE("mesher: a pole becomes a closed tube whose volume is the truncated cone's") {
  const Mesh mesh = build_mesh(pole(10), {.sides_min = 64, .sides_max = 64, .root_flare = 0.0});
  check_sound(mesh);
  // pi/3 h (R^2 + R r + r^2), and the tip's cone, as long as it is wide.
  const double expected = std::numbers::pi / 3 * (10 * (0.01 + 0.005 + 0.0025) + 0.1 * 0.0025);
  CHECK(std::abs(volume(mesh) - expected) < 0.003 * expected);
}

TEST_CASE("mesher: every edge of a tube is shared by two triangles, by place") {
  const Mesh mesh = build_mesh(pole(5), {});
  using Point = std::array<float, 3>;
  std::map<std::pair<Point, Point>, int> edges;
  const auto point = [](const Vec3f& p) { return Point{p.x, p.y, p.z}; };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point a = point(corner(mesh, t, i));
      const Point b = point(corner(mesh, t, (i + 1) % 3));
      edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  // Each edge once in either direction: closed, and all triangles face the same way.
  for (const auto& [edge, balance] : edges) CHECK(balance == 0);
}

TEST_CASE("mesher: the meshes of all trees are sound and face outwards") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Mesh mesh = build_mesh(random_tree(seed, 200), {});
    check_sound(mesh);
    CHECK(volume(mesh) > 0);
  }
}

TEST_CASE("mesher: no triangle faces against its corners' normals, in narrow forks and sharp turns neither") {
  const EngineRegistry& registry = test::both_engines();
  std::vector<std::pair<std::string, Skeleton>> trees;
  trees.emplace_back("slim", slim_tree(6));
  for (const char* preset : {"s4-fig6", "decurrent", "weeping", "columnar", "xm12-a", "xm12-b", "xm12-e",
                             "xm12-f", "xm12-i", "xm12-m", "xm12-fig5", "x18-d10-a60", "x18-d15-a90"})
    trees.emplace_back(preset, living(load_job(registry, preset).run({}).skeleton));
  for (const auto& [name, tree] : trees) {
    for (const CentreLine line : {CentreLine::polyline, CentreLine::catmull_rom}) {
      const Mesh mesh = build_mesh(tree, {.centre_line = line});
      std::size_t flipped = 0;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Vec3f sum(0.0f);
        for (const std::uint32_t vertex : mesh.triangles[t]) sum += mesh.normals[vertex];
        flipped += glm::dot(sum, area_vector(mesh, t)) <= 0;
      }
      INFO(name << (line == CentreLine::polyline ? ", polyline" : ", catmull-rom"));
      CHECK(flipped == 0);
    }
  }
}

TEST_CASE("mesher: a lateral's collar begins within its parent's facets and flows over into the lateral") {
  for (const double angle_deg : {30.0, 60.0, 90.0, 120.0}) {
    for (const double diameter : {0.01, 0.05, 0.1, 0.15}) {
      Skeleton s = pole(4);
      for (double& d : s.diameter) d = 0.2;
      const double angle = radians(angle_deg);
      for (int i = 1; i <= 3; ++i) {
        s.position.push_back(Vec3(0, 2, 0) + 0.8 * i * Vec3(std::sin(angle), std::cos(angle), 0));
        s.parent.push_back(i == 1 ? 2 : static_cast<std::uint32_t>(s.node_count() - 2));
        s.diameter.push_back(diameter);
        s.kind.push_back(Kind::stem);
      }
      assign_axes(s);
      const Mesh mesh = build_mesh(s, {.root_flare = 0.0});
      const Mesh trunk = build_mesh(pole_of_width(4, 0.2), {.root_flare = 0.0});
      INFO(angle_deg << " degrees, " << diameter << " m");
      // Lines that would fold spread less.
      const bool spreads = angle_deg > 40.0 && diameter > 0.02;
      // The trunk comes first, then the collar's first ring; a ring ends where u is 1.
      std::size_t feet = 0;
      for (std::size_t v = trunk.vertex_count(); v < mesh.vertex_count(); ++v) {
        ++feet;
        const Vec3f& p = mesh.positions[v];
        CHECK(mesh.internodes[v] > 4);
        CHECK(std::hypot(p.x, p.z) < 0.1 * std::cos(std::numbers::pi / 12));
        if (spreads) {
          CHECK(std::hypot(p.x, p.z) > 0.09);
          CHECK(glm::dot(mesh.normals[v], Vec3f(p.x, 0, p.z) / std::hypot(p.x, p.z)) > 0.999f);
        }
        if (mesh.uvs[v].x == 1.0f) break;
      }
      CHECK(feet >= 4);
      for (std::size_t v = trunk.vertex_count() + feet; v < mesh.vertex_count(); ++v) {
        const Vec3 along(std::sin(angle), std::cos(angle), 0);
        const Vec3 from = Vec3(mesh.positions[v]) - Vec3(0, 2, 0);
        const double off = glm::length(from - along * glm::dot(from, along));
        CHECK(off < 2.0 * diameter + 1e-5);
      }
    }
  }
}

TEST_CASE("mesher: thick axes get more sides than twigs, within the limits") {
  const Mesh coarse = build_mesh(binary_tree(6), {.sides_min = 3, .sides_max = 3});
  const Mesh mixed = build_mesh(binary_tree(6), {.sides_min = 3, .sides_max = 16});
  const Mesh fine = build_mesh(binary_tree(6), {.sides_min = 16, .sides_max = 16});
  CHECK(coarse.triangles.size() < mixed.triangles.size());
  CHECK(mixed.triangles.size() < fine.triangles.size());
}

TEST_CASE("mesher: a tree without internodes makes an empty mesh") {
  Skeleton seed = pole(1);
  seed = subset(seed, {true, false});
  const Mesh mesh = build_mesh(seed, {});
  CHECK(mesh.triangles.empty());
  CHECK(mesh.ranges.empty());
}

TEST_CASE("mesher: cones are closed, face outwards and fill what the cones and spheres of a pole fill") {
  const Mesh mesh = build_mesh(pole(10), {.method = MeshMethod::cones, .sides_min = 64, .sides_max = 64});
  check_sound(mesh);
  float lowest = 1.0f;
  float widest = 0.0f;
  for (const Vec3f& p : mesh.positions) {
    lowest = std::min(lowest, p.y);
    widest = std::max(widest, std::hypot(p.x, p.z));
  }
  CHECK(lowest == 0.0f);  // it stands on the ground
  CHECK(widest == Approx(0.1).margin(1e-5));
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Mesh random = build_mesh(random_tree(seed, 200), {.method = MeshMethod::cones});
    check_sound(random);
    for (std::size_t t = 0; t < random.triangles.size(); ++t) {
      Vec3f sum(0.0f);
      for (const std::uint32_t vertex : random.triangles[t]) sum += random.normals[vertex];
      CHECK(glm::dot(sum, area_vector(random, t)) > 0);
    }
  }
}

TEST_CASE("mesher: where cones meet at a bend they have the same bark, and so has the sphere between them") {
  for (const double turn_deg : {5.0, 30.0, 60.0, 90.0, 110.0}) {
    const double turn = radians(turn_deg);
    Skeleton tree;
    add_node(tree, {0, 0, 0}, kNoParent, 0.2);
    add_node(tree, {0, 1, 0}, 0, 0.2);
    add_node(tree, {std::sin(turn), 1 + std::cos(turn), 0}, 1, 0.2);
    assign_axes(tree);
    const std::uint32_t sides = 12;
    const Mesh mesh = build_mesh(tree, {.method = MeshMethod::cones, .sides_max = sides});
    const Vec3 bend =
        glm::normalize(Vec3(std::sin(turn), 1 + std::cos(turn), 0));  // the cones meet across it
    const auto first_of = [&](std::uint32_t node) {
      return static_cast<std::size_t>(std::find(mesh.internodes.begin(), mesh.internodes.end(), node) -
                                      mesh.internodes.begin());
    };
    // A node's cone comes first: its lower ring, then its upper one.
    const auto on_bend = [&](std::uint32_t node, std::uint32_t side) {
      const std::size_t low = first_of(node) + side;
      const std::size_t high = low + sides + 1;
      const double from = glm::dot(Vec3(mesh.positions[low]) - Vec3(0, 1, 0), bend);
      const double to = glm::dot(Vec3(mesh.positions[high]) - Vec3(0, 1, 0), bend);
      return glm::mix(Vec2f(mesh.uvs[low]), Vec2f(mesh.uvs[high]), static_cast<float>(from / (from - to)));
    };
    INFO(turn_deg << " degrees");
    for (std::uint32_t side = 0; side <= sides; ++side) {
      const Vec2f below = on_bend(1, side);
      CHECK(glm::distance(below, on_bend(2, side)) < 1e-4f);
      CHECK(below.x == Approx(static_cast<float>(side) / sides));
      CHECK(below.y == Approx(on_bend(1, 0).y).margin(1e-4));
    }
    // On the outer side a ring of the sphere lies in that plane.
    std::size_t met = 0;
    for (std::size_t v = first_of(1) + 2 * (sides + 1); v < first_of(2); ++v) {
      const Vec3 from = Vec3(mesh.positions[v]) - Vec3(0, 1, 0);
      if (std::abs(glm::dot(from, bend)) > 1e-6) continue;
      ++met;
      CHECK(mesh.uvs[v].y == Approx(on_bend(1, 0).y).margin(1e-4));
    }
    CHECK(met >= sides);
  }
}

TEST_CASE("mesher: cones stand flat on the ground, but for a tree with roots") {
  const MesherOptions cones{.method = MeshMethod::cones};
  const auto lowest = [](const Mesh& mesh) {
    const auto is_lower = [](const Vec3f& a, const Vec3f& b) { return a.y < b.y; };
    return std::min_element(mesh.positions.begin(), mesh.positions.end(), is_lower)->y;
  };
  Skeleton leaning;
  add_node(leaning, {0, 0, 0}, kNoParent, 0.4);
  add_node(leaning, {0.5, 0.6, 0}, 0, 0.4);
  assign_axes(leaning);
  const Mesh mesh = build_mesh(leaning, cones);
  check_sound(mesh);
  CHECK(lowest(mesh) == 0.0f);
  add_node(leaning, {0, -1, 0}, 0, 0.2);
  assign_axes(leaning);
  CHECK(lowest(build_mesh(leaning, cones)) < -0.9f);
}

TEST_CASE("mesher: each level of detail has at most a third of the triangles, a budget is kept") {
  for (const MeshMethod method : {MeshMethod::smooth, MeshMethod::cones}) {
    for (const Skeleton& tree : {slim_tree(9), random_tree(4, 2000)}) {
      const std::size_t full = build_mesh(tree, {.method = method}).triangles.size();
      std::size_t limit = full;
      for (int lod = 1; lod <= 3; ++lod) {
        const Mesh mesh = build_mesh(tree, {.method = method, .lod = lod});
        check_sound(mesh);
        limit /= 3;
        CHECK(mesh.triangles.size() <= limit);
        CHECK(mesh.triangles.size() > limit / 2);
      }
      // A budget is nearly used up.
      const int budget = static_cast<int>(full / 5);
      const Mesh mesh = build_mesh(tree, {.method = method, .max_triangles = budget});
      CHECK(static_cast<int>(mesh.triangles.size()) <= budget);
      CHECK(static_cast<int>(mesh.triangles.size()) > budget / 2);
      CHECK_THROWS_WITH(build_mesh(tree, {.method = method, .max_triangles = 2}),
                        ContainsSubstring("mesher: the tree's mesh has at least") &&
                            ContainsSubstring("2 are allowed by lod and max_triangles"));
    }
  }
}

TEST_CASE("mesher: wood that is left out or straightened is within five times the tolerance of what stays") {
  const Skeleton tree = slim_tree(6);
  const Mesh full = build_mesh(tree, {});
  for (const double tolerance : {0.005, 0.02, 0.1}) {
    const Mesh coarse = smooth_mesh(tree, {}, tolerance);
    CHECK(coarse.triangles.size() < full.triangles.size());
    double farthest = 0.0;
    for (const Vec3f& p : full.positions) {
      double nearest = 1e9;
      for (std::size_t t = 0; t < coarse.triangles.size() && nearest > 0.5 * tolerance; ++t) {
        nearest = std::min(nearest, distance_to_triangle(coarse, t, p));
      }
      farthest = std::max(farthest, nearest);
    }
    CHECK(farthest < 5.0 * tolerance);
  }
}

TEST_CASE("mesher: vertices show an attribute of their internode, or it is said which there are") {
  const Skeleton tree = random_tree(3, 300);
  for (const MeshMethod method : {MeshMethod::smooth, MeshMethod::cones}) {
    for (const std::string& name : color_attributes(tree)) {
      const Mesh mesh = build_mesh(tree, {.method = method, .color_by = name});
      const std::vector<Color> colors = attribute_colors(tree, name);
      REQUIRE(mesh.colors.size() == mesh.vertex_count());
      std::size_t wrong = 0;
      for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        wrong += mesh.colors[v] != color_bytes(colors[mesh.internodes[v]]);
      }
      CHECK(wrong == 0);
    }
  }
  CHECK(build_mesh(tree, {}).colors.empty());
  CHECK_THROWS_WITH(build_mesh(pole(2), {.color_by = "light"}),
                    "mesher.color_by: the tree has no attribute 'light' (it has order, strahler, width)");
}

TEST_CASE("mesher: wood that shows an attribute is not dressed in bark") {
  const Skeleton tree = random_tree(3, 300);
  Looks looks;
  looks.mesher.color_by = "order";
  looks.leaves = {};
  const Mesh mesh = make_tree_mesh(tree, looks, 1).mesh;
  const std::vector<Color> colors = attribute_colors(tree, "order");
  std::size_t wrong = 0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    wrong += mesh.colors[v] != color_bytes(colors[mesh.internodes[v]]);
  }
  CHECK(wrong == 0);
  CHECK(mesh.materials.at(0).color == Vec3f(1.0f));
  CHECK(mesh.materials.at(0).image.is_empty());
}

TEST_CASE("mesher: all corners of a triangle belong to one axis, so that its texture does not jump") {
  const Skeleton tree = random_tree(7, 500);
  for (const MeshMethod method : {MeshMethod::smooth, MeshMethod::cones}) {
    const Mesh mesh = build_mesh(tree, {.method = method});
    std::size_t wrong = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const auto axis = [&](std::uint32_t vertex) { return tree.axis[mesh.internodes[vertex]]; };
      wrong += axis(a) != axis(b) || axis(a) != axis(c);
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("mesher: a curve through the nodes has many rings in bends and few where it is straight") {
  Skeleton bent = pole(6);
  for (std::size_t i = 0; i < bent.node_count(); ++i) {
    const double angle = radians(25.0) * static_cast<double>(i);
    bent.position[i] = 2.0 * Vec3(1.0 - std::cos(angle), std::sin(angle), 0);
  }
  for (const CentreLine line : {CentreLine::polyline, CentreLine::catmull_rom}) {
    const MesherOptions options{.centre_line = line, .sides_min = 12, .root_flare = 0.0};
    const Mesh curved = build_mesh(bent, options);
    CHECK(curved.triangles.size() > 3 * build_mesh(pole(6), options).triangles.size() / 2);
    check_sound(curved);
    // All around the circle of 2 m, on which the nodes lie; chords and arcs cut it by 5 cm.
    for (const Vec3f& p : curved.positions) {
      const double off = std::hypot(std::hypot(p.x - 2.0, p.y) - 2.0, p.z);
      if (p.y > 0.3 && p.x < 3.3) CHECK(off < 0.1 + 0.05);
    }
  }
}

TEST_CASE("mesher: a trunk's foot widens, not that of trees with roots, nor beyond a seedling's foot") {
  const auto widest = [](const Mesh& mesh, float low, float high) {
    float result = 0.0f;
    for (const Vec3f& p : mesh.positions) {
      if (p.y >= low && p.y <= high) result = std::max(result, std::hypot(p.x, p.z));
    }
    return result;
  };
  Skeleton s = pole_of_width(10, 0.2);
  const Mesh flared = build_mesh(s, {});
  CHECK(widest(flared, -1, 0.01f) > 0.15f);
  CHECK(widest(flared, 0.4f, 20) < 0.1001f);
  CHECK(widest(build_mesh(s, {.root_flare = 0.0}), -1, 20) < 0.1001f);
  const Skeleton seedling = pole_of_width(1, 0.2);
  CHECK(widest(build_mesh(seedling, {}), 0.201f, 2) < 0.1001f);
  s.position.push_back(Vec3(0.5, -1, 0));
  s.parent.push_back(0);
  s.diameter.push_back(0.1);
  s.kind.push_back(Kind::root);
  assign_axes(s);
  CHECK(widest(build_mesh(s, {}), 0.2f, 20) < 0.1001f);
}

TEST_CASE(
    "mesher: a trunk that leans stands on the ground with the whole of its base, with a flare or without") {
  for (const double lean_deg : {0.0, 20.0, 40.0, 55.0}) {
    for (const double flare : {0.0, 0.8}) {
      Skeleton s = pole_of_width(6, 0.4);
      const double lean = radians(lean_deg);
      for (Vec3& p : s.position) p = Vec3(std::sin(lean), std::cos(lean), 0) * p.y;
      const Mesh mesh = build_mesh(s, {.root_flare = flare});
      INFO(lean_deg << " degrees, flare " << flare);
      std::size_t on_ground = 0;
      std::size_t flipped = 0;
      for (const Vec3f& p : mesh.positions) {
        CHECK(p.y > -1e-6f);
        on_ground += p.y < 1e-6f;
      }
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Vec3f sum(0.0f);
        for (const std::uint32_t vertex : mesh.triangles[t]) sum += mesh.normals[vertex];
        flipped += glm::dot(sum, area_vector(mesh, t)) <= 0;
      }
      // The ring, the rim of the closed base and its center.
      CHECK(on_ground == (flare > 0.0 ? 2 * 24 + 2 : 2 * 12 + 2));
      CHECK(flipped == 0);
    }
  }
}

TEST_CASE("mesher: skeletons at the edge of sense give sound meshes or none") {
  std::vector<Skeleton> trees;
  trees.push_back(random_tree(1, 50));
  for (Vec3& p : trees.back().position) p = Vec3(1, 2, 3);  // all in one place
  trees.push_back(random_tree(2, 50));
  for (double& d : trees.back().diameter) d = 0.0;
  trees.push_back(random_tree(3, 50));
  for (std::size_t i = 0; i < 25; ++i) trees.back().position[2 * i + 1] = trees.back().position[2 * i];
  trees.push_back(pole(9));  // there and back
  for (std::size_t i = 0; i < 10; ++i) trees.back().position[i] = Vec3(0, i % 2, 0);
  trees.push_back(random_tree(5, 50));
  for (Vec3& p : trees.back().position) p += Vec3(1e5, 0, 1e5);
  trees.push_back(random_tree(6, 50));
  for (double& d : trees.back().diameter) d *= 30.0;
  for (const Skeleton& tree : trees) {
    for (const MeshMethod method : {MeshMethod::smooth, MeshMethod::cones}) {
      for (const CentreLine line : {CentreLine::polyline, CentreLine::catmull_rom}) {
        const Mesh mesh = build_mesh(tree, {.method = method, .centre_line = line});
        for (const Vec3f& p : mesh.positions) REQUIRE(std::isfinite(p.x + p.y + p.z));
        for (const Vec3f& n : mesh.normals) REQUIRE(std::abs(glm::length(n) - 1.0f) < 1e-4f);
        for (const Vec2f& uv : mesh.uvs) REQUIRE(std::isfinite(uv.x + uv.y));
        for (const auto& triangle : mesh.triangles) {
          for (const std::uint32_t vertex : triangle) REQUIRE(vertex < mesh.vertex_count());
        }
      }
    }
  }
}

TEST_CASE("mesher: the number of threads does not change the mesh") {
  const Skeleton tree = random_tree(1, 5000);
  Mesh one;
  {
    const ThreadLimit limit(1);
    one = build_mesh(tree, {});
  }
  const ThreadLimit limit(2);
  check_same(one, build_mesh(tree, {}));
}

TEST_CASE("mesher: plain tubes, written four at a time, are those that are written one by one") {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Skeleton tree = random_tree(seed, 3000);
    const double thickest = *std::ranges::max_element(tree.diameter);
    for (std::size_t node = 0; node < tree.node_count(); ++node) {
      if (tree.order[node] > 1) tree.diameter[node] *= 0.01 * thickest;
    }
    if (seed == 3) tree.position[100] = tree.position[tree.parent[100]];  // a stretch without a direction
    const Axes axes = find_axes(tree);
    TubePlan plan = plan_tubes(tree, axes, {});
    const auto plain = std::ranges::count_if(plan.tubes, &Tube::is_plain);
    CHECK(3 * plain > std::ssize(plan.tubes));
    CHECK(plain < std::ssize(plan.tubes));
    const Mesh mesh = sweep(plan);
    for (Tube& tube : plan.tubes) tube.is_plain = false;
    check_same(mesh, sweep(plan));
  }
}

TEST_CASE("mesher: a mesh in the memory of another is the one in memory of its own") {
  const Skeleton large = random_tree(1, 3000);
  const Skeleton small = random_tree(2, 1000);
  for (const MeshMethod method : {MeshMethod::smooth, MeshMethod::cones}) {
    Looks looks;
    looks.mesher.method = method;
    Mesh memory = make_tree_mesh(large, looks, 1).mesh;  // with bark, tangents and colours
    const Vec3f* place = memory.positions.data();
    const Mesh mesh = build_mesh(small, {.method = method}, std::move(memory));
    check_same(mesh, build_mesh(small, {.method = method}));
    if (method == MeshMethod::smooth) CHECK(mesh.positions.data() == place);
  }
}

TEST_CASE("mesher: a lateral at the root is as thin there as further on") {
  Skeleton s = pole(2);
  s.position.push_back(Vec3(1, 0, 0));
  s.parent.push_back(0);
  s.diameter.push_back(0.02);
  s.kind.push_back(Kind::stem);
  assign_axes(s);
  const Mesh mesh = build_mesh(s, {});
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.internodes[v] != 3) continue;
    const Vec3f& p = mesh.positions[v];
    if (p.x > 0.13f) CHECK(std::hypot(p.y, p.z) < 0.0101f);  // beyond the collar
  }
}
