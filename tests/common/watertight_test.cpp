#include "common/mesh/watertight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "common/base/errors.h"
#include "common/base/parallel.h"
#include "common/config/job.h"
#include "common/mesh/chart_borders.h"
#include "common/mesh/wood_field.h"
#include "common/skeleton/passes.h"
#include "growth/engine.h"
#include "tests/catch.h"
#include "tests/common/manifolds.h"
#include "tests/common/trees.h"
#include "tests/engines.h"

using namespace ramify;
using namespace ramify::test;

namespace {

Mesh watertight(const Skeleton& skeleton, MesherOptions options) {
  options.method = MeshMethod::watertight;
  return build_mesh(skeleton, options);
}

/// Of truncated cones.
double wood_volume(const Skeleton& s) {
  double sum = 0.0;
  for (std::size_t node = 0; node < s.node_count(); ++node) {
    if (s.is_root(node)) continue;
    const double a = s.start_radius(node);
    const double b = 0.5 * s.diameter[node];
    sum += std::numbers::pi / 3 * s.length(node) * (a * a + a * b + b * b);
  }
  return sum;
}

/// A trunk of two internodes, 0.2 m thick, with a lateral half as thick.
Skeleton y_fork() {
  Skeleton s;
  add_node(s, {0, 0, 0}, kNoParent, 0.2);
  add_node(s, {0, 1, 0}, 0, 0.2);
  add_node(s, {0, 2, 0}, 1, 0.2);
  add_node(s, {1, 2, 0}, 1, 0.1);
  assign_axes(s);
  return s;
}

std::string error_of(const Skeleton& skeleton, const MesherOptions& options) {
  try {
    watertight(skeleton, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// The axes of the vertices at each place.
std::map<std::array<float, 3>, std::set<std::uint32_t>> axes_of_places(const Skeleton& tree,
                                                                       const Mesh& mesh) {
  std::map<std::array<float, 3>, std::set<std::uint32_t>> axes;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3f& p = mesh.positions[v];
    axes[{p.x, p.y, p.z}].insert(tree.axis[mesh.internodes[v]]);
  }
  return axes;
}

void check_closed(const Mesh& as_made, std::size_t pieces) {
  const Mesh mesh = welded(as_made);
  const std::vector<std::string> found = manifold_violations(mesh);
  INFO(found.size() << " violations, the first: " << (found.empty() ? "" : found.front()));
  CHECK(found.empty());
  CHECK(component_count(mesh) == pieces);
  CHECK(euler_characteristic(mesh) % 2 == 0);
  CHECK(self_intersections(mesh) == 0);
  CHECK(enclosed_volume(mesh) > 0);
}

}  // namespace

TEST_CASE("watertight: one internode is its truncated cone and half a ball at the tip") {
  const Skeleton tree = pole(1);
  const double expected = wood_volume(tree) + 2.0 / 3.0 * std::numbers::pi * std::pow(0.05, 3);
  for (const double adaptivity : {0.0, 0.1}) {
    const Mesh mesh = watertight(tree, {.voxel_size = 0.01, .adaptivity = adaptivity});
    check_closed(mesh, 1);
    CHECK(euler_characteristic(welded(mesh)) == 2);
    CHECK(std::abs(enclosed_volume(mesh) / expected - 1.0) < 0.015);
    CHECK(std::all_of(mesh.internodes.begin(), mesh.internodes.end(), [](auto node) { return node == 1; }));
    float lowest = 1.0f;
    float highest = 0.0f;
    for (const Vec3f& p : mesh.positions) {
      lowest = std::min(lowest, p.y);
      highest = std::max(highest, p.y);
    }
    CHECK(std::abs(lowest) < 0.001f);  // flat, to stand on
    CHECK(std::abs(highest - 1.05f) < 0.001f);
  }
}

TEST_CASE("watertight: where one cone ends and the next begins nothing bulges") {
  const Mesh mesh = watertight(pole(10), {.voxel_size = 0.01});
  for (const Vec3f& p : mesh.positions) {
    if (p.y > 10.0f) continue;
    CHECK(std::hypot(p.x, p.z) < 0.1f - 0.005f * p.y + 0.0015f);
  }
}

TEST_CASE("watertight: a fork is one piece, and its blend adds little") {
  const Skeleton tree = y_fork();
  const Mesh sharp = watertight(tree, {.voxel_size = 0.01, .blend = 0.0});
  const Mesh blended = watertight(tree, {.voxel_size = 0.01, .blend = 1.0});
  for (const Mesh* mesh : {&sharp, &blended}) {
    check_closed(*mesh, 1);
    CHECK(euler_characteristic(welded(*mesh)) == 2);
  }
  const double added = enclosed_volume(blended) - enclosed_volume(sharp);
  CHECK(added > 0.00005);
  CHECK(added < 0.01 * enclosed_volume(sharp));
  // Away from the fork, also behind it, both are the same.
  for (const Vec3f& p : blended.positions) {
    if (p.x < 0.0f && p.y < 1.9f) CHECK(std::hypot(p.x, p.z) < 0.101f);
  }
}

TEST_CASE("watertight: internodes without length and jumps of width change nothing of that") {
  Skeleton tree = y_fork();
  add_node(tree, {1, 2, 0}, 3, 0.1);       // no length
  add_node(tree, {1.5, 2.2, 0}, 4, 0.3);   // thick after thin
  add_node(tree, {2.5, 2.2, 0}, 5, 0.05);  // thin after thick
  assign_axes(tree);
  const Mesh mesh = watertight(tree, {.voxel_size = 0.015});
  check_closed(mesh, 1);
  CHECK(mesh.warnings.empty());
}

TEST_CASE("watertight: two trees apart are two pieces, two that touch are one") {
  Skeleton other = y_fork();
  for (Vec3& p : other.position) p.z += 1.0;
  check_closed(watertight(joined({y_fork(), other}), {.voxel_size = 0.02}), 2);
  for (Vec3& p : other.position) p.z -= 0.9;
  check_closed(watertight(joined({y_fork(), other}), {.voxel_size = 0.02}), 1);
}

TEST_CASE("watertight: trees whose branches cross at random are closed all the same") {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    INFO("seed " << seed);
    const Mesh mesh = watertight(random_tree(seed, 100), {.voxel_size = 0.03, .adaptivity = 0.1});
    check_closed(mesh, 1);
  }
}

TEST_CASE("watertight: presets of both engines at a coarse size") {
  const EngineRegistry& registry = test::both_engines();
  const std::vector<std::pair<std::string, double>> presets = {{"s4-fig6", 0.006},
                                                               {"s4-improved", 0.012},
                                                               {"columnar", 0.012},
                                                               {"xm12-a", 0.03},
                                                               {"x18-d10-a60", 0.03}};
  for (const auto& [name, voxel_size] : presets) {
    INFO(name);
    const Skeleton tree = living(load_job(registry, name).run({}).skeleton);
    check_closed(watertight(tree, {.voxel_size = voxel_size}), tree.root_count());
  }
}

TEST_CASE("watertight: the volume is the wood's where laterals are few and thin") {
  // Cones of a lateral overlap its parent's: what is counted twice is a thousandth here.
  Skeleton tree = pole(10);
  for (std::uint32_t node = 2; node < 10; node += 2) {
    add_node(tree, tree.position[node] + Vec3(node % 4 == 0 ? 1.0 : -1.0, 0.7, 0), node, 0.04);
  }
  assign_axes(tree);
  const Mesh mesh = watertight(tree, {.voxel_size = 0.01});
  check_closed(mesh, 1);
  CHECK(std::abs(enclosed_volume(mesh) / wood_volume(tree) - 1.0) < 0.02);
}

TEST_CASE("watertight: twigs thinner than two voxels are told and left out, or closed tubes if asked") {
  Skeleton tree = pole(2);
  add_node(tree, {1, 2, 0}, 1, 0.01);
  add_node(tree, {2, 2, 0}, 3, 0.1);  // thick, but on the thin one
  assign_axes(tree);
  const Mesh without = watertight(tree, {.voxel_size = 0.02});
  check_closed(without, 1);
  REQUIRE(without.warnings.size() == 1);
  CHECK(without.warnings[0].rfind("watertight: 2 of 4 internodes, 0.00302 m3 of wood (", 0) == 0);
  CHECK(without.warnings[0].find("thinner than 2 voxels of 0.02 m or grow on such: left out") !=
        std::string::npos);

  const Mesh with = watertight(tree, {.voxel_size = 0.02, .thin_twigs = ThinTwigs::tubes});
  CHECK(manifold_violations(welded(with)).empty());
  CHECK(component_count(welded(with)) == 2);
  CHECK(euler_characteristic(welded(with)) == 4);
  CHECK(enclosed_volume(with) > enclosed_volume(without) + 0.001);
  CHECK(with.warnings.at(0).find("kept as 1 closed tubes") != std::string::npos);
  CHECK(with.ranges.at(0).triangle_count == with.triangles.size());
}

TEST_CASE("watertight: the size chosen resolves the thinnest twig, or is as fine as voxels allow") {
  const WatertightPlan fine = plan_watertight(y_fork(), {});
  CHECK(fine.voxel_size == Approx(0.1 / 3));
  Skeleton tree = y_fork();
  add_node(tree, {0, 2, 1}, 1, 0.0005);
  assign_axes(tree);
  const WatertightPlan limited = plan_watertight(tree, {});
  CHECK(limited.voxel_size > 0.0005 / 3);
  CHECK(limited.predicted_voxels <= kActiveVoxelsMax);
  CHECK(limited.predicted_voxels > 0.9 * kActiveVoxelsMax);
}

TEST_CASE("watertight: a size that cannot be is one line that says which can") {
  const std::string fine = error_of(y_fork(), {.voxel_size = 1e-4});
  CHECK(fine.rfind("mesher.voxel_size: 0.0001 m takes about ", 0) == 0);
  CHECK(fine.find("million voxels, more than 50 (at least 0.000") != std::string::npos);
  CHECK(error_of(y_fork(), {.voxel_size = 0.5}) ==
        "mesher.voxel_size: 0.5 m is too coarse for a trunk 0.2 m thick (at most 0.1)");
  Skeleton nothing = y_fork();
  std::fill(nothing.diameter.begin(), nothing.diameter.end(), 0.0);
  CHECK(error_of(nothing, {}) == "watertight: no internode at a root has a width");
}

TEST_CASE("watertight: the number of threads does not change the mesh") {
  const Skeleton tree = random_tree(7, 60);
  const MesherOptions options = {.voxel_size = 0.03, .thin_twigs = ThinTwigs::tubes};
  Mesh one;
  {
    const ThreadLimit limit(1);
    one = watertight(tree, options);
  }
  const ThreadLimit limit(3);
  const Mesh three = watertight(tree, options);
  CHECK(one.positions == three.positions);
  CHECK(one.normals == three.normals);
  CHECK(one.uvs == three.uvs);
  CHECK(one.internodes == three.internodes);
  CHECK(one.triangles == three.triangles);
}

TEST_CASE("watertight: adaptivity saves triangles where the wood is smooth") {
  const std::size_t even = watertight(y_fork(), {.voxel_size = 0.01, .adaptivity = 0.0}).triangles.size();
  const std::size_t adaptive = watertight(y_fork(), {.voxel_size = 0.01, .adaptivity = 0.1}).triangles.size();
  CHECK(2 * adaptive < even);
}

TEST_CASE("watertight: with the size chosen presets whose twigs are resolved keep their volume") {
  // Cones overlap at forks, where their sum counts wood twice: that is most of what is missing.
  EngineRegistry registry;
  growth::register_engine(registry);
  for (const std::string name : {"s4-fig3", "s4-fig5", "s4-fig6", "s4-fig7"}) {
    INFO(name);
    const Skeleton tree = living(load_job(registry, name).run({}).skeleton);
    const Mesh mesh = watertight(tree, {});
    CHECK(mesh.warnings.empty());
    CHECK(enclosed_volume(mesh) / wood_volume(tree) > 0.96);
    CHECK(enclosed_volume(mesh) / wood_volume(tree) < 1.02);
  }
}

TEST_CASE("watertight: chords take nothing away from a thin pole's volume") {
  Skeleton tree;
  add_node(tree, {0, 0, 0}, kNoParent, 0.1);
  add_node(tree, {0.3, 2, 0.2}, 0, 0.1);
  assign_axes(tree);
  const double expected = wood_volume(tree) + 2.0 / 3.0 * std::numbers::pi * std::pow(0.05, 3);
  for (const double adaptivity : {0.0, 0.1, 0.3}) {
    const Mesh mesh = watertight(tree, {.voxel_size = 0.1 / 3, .adaptivity = adaptivity});
    INFO(adaptivity);
    CHECK(std::abs(enclosed_volume(mesh) / expected - 1.0) < 0.02);
  }
}

TEST_CASE("watertight: a blend that reaches farther than its cones belongs to one of them") {
  // Two limbs at a right angle, thick in voxels: what fills their crotch is leaves away from both.
  Skeleton tree;
  add_node(tree, {0, 0, 0}, kNoParent, 0.4);
  add_node(tree, {0, 1, 0}, 0, 0.4);
  add_node(tree, {0, 2, 0}, 1, 0.4);
  add_node(tree, {1, 1.2, 0}, 1, 0.4);
  assign_axes(tree);
  const Mesh mesh = watertight(tree, {.voxel_size = 0.005, .blend = 2.0});
  CHECK(std::none_of(mesh.internodes.begin(), mesh.internodes.end(), [](auto node) { return node == 0; }));
  check_closed(mesh, 1);
}

TEST_CASE("watertight: no triangle stretches the texture across where its ends meet, or two axes do") {
  const Skeleton tree = random_tree(3, 40);
  const Mesh mesh = watertight(tree, {.voxel_size = 0.02});
  CHECK(mesh.vertex_count() > welded(mesh).vertex_count());
  std::size_t stretched = 0;
  for (const auto& triangle : mesh.triangles) {
    const std::uint32_t axis = tree.axis[mesh.internodes[triangle[0]]];
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(tree.axis[mesh.internodes[triangle[i]]] == axis);
      stretched += std::abs(mesh.uvs[triangle[i]].x - mesh.uvs[triangle[(i + 1) % 3]].x) > 0.5f;
    }
  }
  // At the poles of tips, which u goes around.
  CHECK(stretched < mesh.triangles.size() / 200);
}

TEST_CASE("watertight: the texture runs on evenly along thick wood that bends in short internodes") {
  Skeleton tree;
  add_node(tree, {0, 0, 0}, kNoParent, 0.5);
  for (std::uint32_t i = 1; i <= 8; ++i)
    add_node(tree, {i % 2 == 0 ? 0.1 : 0.0, 0.2 * i, i % 3 == 0 ? 0.1 : 0.0}, i - 1, 0.5);
  assign_axes(tree);
  const Mesh mesh = watertight(tree, {.voxel_size = 0.03});
  // v is metres by the girth of half a metre's width; its slope may grow on the inner side of bends.
  const double girth = 0.5 * std::numbers::pi;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle[i];
      const std::uint32_t b = triangle[(i + 1) % 3];
      if (mesh.positions[a].y > 1.55f || mesh.positions[a].y < 0.05f) continue;  // tip and cut
      const double length = glm::distance(mesh.positions[a], mesh.positions[b]);
      CHECK(std::abs(mesh.uvs[a].y - mesh.uvs[b].y) * girth < 2.0 * length);
    }
  }
}

TEST_CASE("watertight: a trunk that leans is cut off level with the ground, nothing bulges below") {
  Skeleton tree;
  add_node(tree, {0, 0, 0}, kNoParent, 0.4);
  add_node(tree, {0.05, 0.1, 0}, 0, 0.4);
  add_node(tree, {0.5, 1, 0}, 1, 0.4);
  assign_axes(tree);
  const Mesh mesh = watertight(tree, {.voxel_size = 0.02});
  check_closed(mesh, 1);
  std::size_t on_ground = 0;
  for (const Vec3f& p : mesh.positions) {
    CHECK(p.y > -0.01f);
    on_ground += p.y < 0.01f;
  }
  CHECK(on_ground > 10);
}

TEST_CASE(
    "watertight: laterals at the root, leaning little or much, blend into the trunk above the ground alone") {
  for (const double lean_deg : {20.0, 45.0, 70.0, 82.0}) {
    for (const double diameter : {0.1, 0.2, 0.4}) {
      if (lean_deg > 80.0 && diameter > 0.2) continue;  // it lies
      Skeleton tree;
      add_node(tree, {0, 0, 0}, kNoParent, 0.4);
      add_node(tree, {0, 0.5, 0}, 0, 0.4);
      add_node(tree, {0, 1, 0}, 1, 0.4);
      const double lean = radians(lean_deg);
      add_node(tree, Vec3(std::sin(lean), std::cos(lean), 0), 0, diameter);
      tree.axis = {0, 0, 0, 1};
      const Mesh mesh = watertight(tree, {.voxel_size = 0.02});
      INFO(lean_deg << " degrees, " << diameter << " m");
      check_closed(mesh, 1);
      float lowest = 1.0f;
      for (const Vec3f& p : mesh.positions) lowest = std::min(lowest, p.y);
      CHECK(lowest > -0.006f);
    }
  }
}

TEST_CASE("watertight: the bark of two axes meets where both are equally near") {
  Skeleton tree;
  add_node(tree, {0, 0, 0}, kNoParent, 0.4);
  add_node(tree, {0, 1, 0}, 0, 0.4);
  add_node(tree, {0, 2, 0}, 1, 0.4);
  add_node(tree, {1, 1.8, 0}, 1, 0.3);
  assign_axes(tree);
  const double voxel_size = 0.02;
  const Mesh mesh = watertight(tree, {.voxel_size = voxel_size});
  const RoundCone below = round_cone({0, 0, 0}, 0.2, {0, 1, 0}, 0.2);
  const RoundCone above = round_cone({0, 1, 0}, 0.2, {0, 2, 0}, 0.2);
  const RoundCone lateral = round_cone({0, 1, 0}, 0.15, {1, 1.8, 0}, 0.15);
  std::size_t count = 0;
  double sum = 0.0;
  for (const auto& [place, there] : axes_of_places(tree, mesh)) {
    if (there.size() < 2) continue;
    const Vec3 p(place[0], place[1], place[2]);
    const double apart = std::abs(lateral.distance(p) - std::min(below.distance(p), above.distance(p)));
    CHECK(apart < 0.5 * voxel_size);
    sum += apart;
    ++count;
  }
  CHECK(count > 40);
  CHECK(sum / static_cast<double>(count) < 0.05 * voxel_size);
}

TEST_CASE("watertight: where several forks blend the bark is that of the nearest wood") {
  const double voxel_size = 0.01;
  const auto direction = [](double lean_deg, double z) {
    return Vec3(std::sin(radians(lean_deg)), std::cos(radians(lean_deg)), z);
  };
  for (const double lean_deg : {20.0, 35.0, 50.0, 65.0}) {
    Skeleton tree;
    add_node(tree, {0, 0, 0}, kNoParent, 0.3);
    add_node(tree, {0, 0.5, 0}, 0, 0.3);
    add_node(tree, {0, 1, 0}, 1, 0.28);
    add_node(tree, tree.position[1] + 0.3 * direction(lean_deg, 0.1), 1, 0.26);
    add_node(tree, tree.position[1] + 0.5 * direction(-lean_deg, 0.3), 1, 0.24);
    add_node(tree, tree.position[3] + 0.5 * direction(lean_deg, 1.0), 3, 0.2);
    add_node(tree, tree.position[3] + 0.5 * direction(-lean_deg, 0.4), 3, 0.2);
    tree.axis = {0, 0, 0, 1, 2, 1, 3};
    const Mesh mesh = watertight(tree, {.voxel_size = voxel_size});
    double farther = 0.0;
    for (const auto& [place, there] : axes_of_places(tree, mesh)) {
      if (there.size() > 1) continue;  // on a border
      const Vec3 p(place[0], place[1], place[2]);
      std::array<double, 4> distances;  // from each axis
      distances.fill(std::numeric_limits<double>::infinity());
      for (std::size_t node = 1; node < tree.node_count(); ++node) {
        const RoundCone cone = round_cone(tree.position[tree.parent[node]], tree.start_radius(node),
                                          tree.position[node], 0.5 * tree.diameter[node]);
        double& least = distances[tree.axis[node]];
        least = std::min(least, cone.distance(p));
      }
      farther = std::max(farther, distances[*there.begin()] - *std::ranges::min_element(distances));
    }
    INFO(lean_deg << " degrees");
    CHECK(farther < 0.75 * voxel_size);
  }
}

TEST_CASE("watertight: coarser levels and budgets have fewer triangles and are as closed") {
  const Skeleton tree = random_tree(5, 60);
  const MesherOptions fine{.voxel_size = 0.015};
  const std::size_t full = watertight(tree, fine).triangles.size();
  for (const int lod : {1, 2}) {
    MesherOptions options = fine;
    options.lod = lod;
    const Mesh mesh = watertight(tree, options);
    INFO(lod);
    const double share =
        static_cast<double>(mesh.triangles.size()) * std::pow(3.0, lod) / static_cast<double>(full);
    CHECK(share < 2.0);
    CHECK(share > 0.5);
    check_closed(mesh, 1);
  }
  MesherOptions options = fine;
  options.max_triangles = static_cast<int>(full / 4);
  const Mesh mesh = watertight(tree, options);
  CHECK(mesh.triangles.size() <= full / 4);
  CHECK(mesh.triangles.size() > full / 16);
  check_closed(mesh, 1);
  options.max_triangles = 20;
  CHECK(error_of(tree, options).find("triangles; 20 are allowed by max_triangles") != std::string::npos);
}

TEST_CASE("watertight: wood that shows in single vertices between two axes makes no saw of their border") {
  // Two poles, and a third one behind them.
  Skeleton s;
  for (const double x : {-1.0, 1.0, 0.0}) add_node(s, {x, -4, x == 0.0 ? -1.2 : -1.0}, kNoParent, 0.2);
  for (std::uint32_t root = 0; root < 3; ++root) add_node(s, s.position[root] + Vec3(0, 8, 0), root, 0.2);
  s.axis = {0, 1, 2, 0, 1, 2};
  for (const std::uint32_t every : {2u, 3u, 4u}) {
    // A wall before them, of squares: of the column in the middle some vertices belong to the third pole.
    constexpr std::uint32_t size = 9;
    Mesh mesh;
    for (std::uint32_t row = 0; row < size; ++row) {
      for (std::uint32_t column = 0; column < size; ++column) {
        const auto x = static_cast<float>(column) - 4.2f;
        const bool is_third = column == 4 && row % every == 0 && row > 1 && row + 2 < size;
        mesh.positions.push_back({x, static_cast<float>(row) - 4.0f, 0});
        mesh.normals.push_back({0, 0, 1});
        mesh.internodes.push_back(is_third ? 5 : x < 0 ? 3 : 4);
        if (row == 0 || column == 0) continue;
        const std::uint32_t v = row * size + column;
        mesh.triangles.push_back({v - size - 1, v - size, v});
        mesh.triangles.push_back({v - size - 1, v, v - 1});
      }
    }
    const std::vector<std::uint32_t> internodes = cut_between_axes(s, mesh);
    INFO("every " << every);
    CHECK(std::count(internodes.begin(), internodes.end(), 5u) == 0);
    for (std::size_t v = size * size; v < mesh.vertex_count(); ++v)
      CHECK(mesh.positions[v].x == Approx(0.0).margin(0.03));
  }
}
