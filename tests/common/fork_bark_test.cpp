// Bark over forks: where it lies, what it shows of the bearer's bark and how it fades out; and what files
// make of it.

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <sstream>

#include "common/base/parallel.h"
#include "common/base/rng.h"
#include "common/mesh/bark.h"
#include "common/mesh/fork_bark.h"
#include "common/mesh/gltf.h"
#include "common/mesh/joints.h"
#include "common/mesh/nearest_triangle.h"
#include "common/mesh/obj.h"
#include "common/mesh/ply.h"
#include "common/mesh/stl.h"
#include "common/mesh/tree_mesh.h"
#include "common/skeleton/passes.h"
#include "tests/catch.h"
#include "tests/common/trees.h"

using namespace ramify;
using namespace ramify::test;

namespace {

constexpr double kTrunk = 0.3;  // metres thick
constexpr std::uint32_t kTrunkNodes = 6;

/// A trunk of even width and a lateral that leaves it half way up.
Skeleton fork(double angle_deg, double diameter, double azimuth_deg = 0.0) {
  Skeleton tree;
  for (std::uint32_t i = 0; i <= kTrunkNodes; ++i)
    add_node(tree, {0, 0.5 * i, 0}, i == 0 ? kNoParent : i - 1, kTrunk);
  const double angle = radians(angle_deg);
  const double azimuth = radians(azimuth_deg);
  const Vec3 along(std::sin(angle) * std::cos(azimuth), std::cos(angle), std::sin(angle) * std::sin(azimuth));
  for (std::uint32_t i = 1; i <= 4; ++i)
    add_node(tree, tree.position[3] + 0.4 * i * along, i == 1 ? 3 : kTrunkNodes - 1 + i, diameter);
  assign_axes(tree);
  return tree;
}

Looks looks_with(MeshMethod method, CentreLine line = CentreLine::polyline) {
  Looks looks;
  looks.bark.resolution = 16;
  looks.mesher.method = method;
  looks.mesher.centre_line = line;
  looks.mesher.root_flare = 0.0;
  return looks;
}

Mesh mesh_of(const Skeleton& tree, const Looks& looks) {
  return make_tree_mesh(tree, looks, 1).mesh;
}

const MaterialRange* overlay_of(const Mesh& mesh) {
  return !mesh.ranges.empty() && mesh.material(mesh.ranges.back()).is_overlay ? &mesh.ranges.back() : nullptr;
}

/// Metres outside of the trunk's even surface.
double from_trunk(const Vec3f& p) {
  return std::hypot(p.x, p.z) - 0.5 * kTrunk;
}

bool is_same(const Mesh& a, const Mesh& b) {
  return a.positions == b.positions && a.uvs == b.uvs && a.colors == b.colors && a.triangles == b.triangles;
}

/// Where the overlay ends it has faded out, but on the trunk, from where it comes.
void check_open_edges(const Mesh& mesh, const MaterialRange& overlay) {
  const auto place = [&](std::uint32_t v) {
    const Vec3f& p = mesh.positions[v];
    return std::tuple(p.x, p.y, p.z);
  };
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::map<std::pair<decltype(place(0)), decltype(place(0))>, std::vector<Edge>> edges;
  for (std::size_t t = overlay.first_triangle; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = mesh.triangles[t][i];
      const std::uint32_t b = mesh.triangles[t][(i + 1) % 3];
      edges[std::minmax(place(a), place(b))].emplace_back(a, b);
    }
  }
  std::size_t ends = 0;
  for (const auto& [at, uses] : edges) {
    if (uses.size() > 1) continue;
    const auto [a, b] = uses[0];
    const bool is_start = mesh.colors[a][3] > 240 && mesh.colors[b][3] > 240;
    if (is_start) CHECK(std::max(from_trunk(mesh.positions[a]), from_trunk(mesh.positions[b])) < 0.05);
    const bool is_inside = std::min(from_trunk(mesh.positions[a]), from_trunk(mesh.positions[b])) < 0.0;
    if (is_start || is_inside) continue;
    ++ends;
    CHECK(int{mesh.colors[a][3]} <= 2);
    CHECK(int{mesh.colors[b][3]} <= 2);
  }
  CHECK(ends > 4);
}

/// How often the texture stands around the trunk.
float most_around(const Mesh& mesh) {
  float most = 0.0f;
  for (const Vec2f& uv : mesh.uvs) most = std::max(most, uv.x);
  return most;
}

}  // namespace

TEST_CASE("nearest triangle: the one that looking at all of them finds") {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Rng rng = Rng::stream(seed, Stream::leaf, 0);
    const auto random = [&] { return Vec3f(Vec3(rng.uniform(), rng.uniform(), rng.uniform())); };
    Mesh mesh;
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < 200; ++i) {
      const Vec3f place = random();
      for (int corner = 0; corner < 3; ++corner) mesh.positions.push_back(place + 0.2f * random());
      if (i % 10 == 0) mesh.positions[3 * i + 2] = mesh.positions[3 * i + 1];  // without area
      mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
      all.push_back(i);
    }
    const TriangleTree tree(mesh, all);
    for (int i = 0; i < 100; ++i) {
      const Vec3f point = 2.0f * random() - 0.5f;
      const NearestTriangle found = tree.nearest(point);
      CHECK(glm::dot(found.point - point, found.point - point) == Approx(found.distance2).margin(1e-6));
      CHECK(found.shares.x + found.shares.y + found.shares.z == Approx(1.0f));
      for (const std::uint32_t other : all) {
        const NearestTriangle one = TriangleTree(mesh, {other}).nearest(point);
        CHECK(found.distance2 <= one.distance2);
        // No corner and no point between is nearer than that.
        for (const Vec3f& at : {Vec3f(1, 0, 0), Vec3f(0, 0.5f, 0.5f), Vec3f(0.2f, 0.3f, 0.5f)}) {
          const Vec3f* p = &mesh.positions[3 * other];
          const Vec3f apart = p[0] * at.x + p[1] * at.y + p[2] * at.z - point;
          CHECK(one.distance2 <= glm::dot(apart, apart) + 1e-6f);
        }
      }
    }
  }
}

TEST_CASE(
    "fork bark: it shows the trunk's bark where that would go on, and fades out before the lateral's own") {
  for (const MeshMethod method : {MeshMethod::smooth, MeshMethod::cones, MeshMethod::watertight}) {
    for (const double angle : {35.0, 60.0, 90.0}) {
      for (const double azimuth : {0.0, 100.0, 170.0, 290.0}) {  // one of them where the texture's ends meet
        Looks looks = looks_with(method);
        looks.mesher.voxel_size = 0.02;
        const Mesh mesh = mesh_of(fork(angle, 0.15, azimuth), looks);
        INFO(static_cast<int>(method) << ", " << angle << " degrees at " << azimuth);
        const MaterialRange* overlay = overlay_of(mesh);
        REQUIRE(overlay != nullptr);
        // By cones laterals begin in the middle of the trunk, where its bark may be anything.
        const double seen = method == MeshMethod::cones ? -0.03 : -kTrunk;  // metres outside
        const SolidPart solid = solid_part(mesh);
        CHECK(solid.triangle_count == overlay->first_triangle);

        // Around the trunk u goes round by as many as stand there, and v up by one a tile's height.
        float repeats = 0.0f;
        for (std::size_t v = 0; v < solid.vertex_count; ++v) {
          if (std::abs(from_trunk(mesh.positions[v])) < 0.01 && mesh.positions[v].y < 0.5f)
            repeats = std::max(repeats,
                               std::round(mesh.uvs[v].x + (method == MeshMethod::watertight ? 1.5f : 0.0f)));
        }
        REQUIRE(repeats >= 3.0f);
        const auto on_trunk = [&](const Vec3f& p) {
          return glm::dvec2(std::atan2(p.x, p.z) / (2.0 * std::numbers::pi),
                            p.y / (std::numbers::pi * kTrunk));
        };
        std::vector<double> u;
        std::vector<double> v;
        std::size_t strong = 0;
        std::size_t faint = 0;
        for (std::size_t i = solid.vertex_count; i < mesh.vertex_count(); ++i) {
          const Vec3f& p = mesh.positions[i];
          const double opacity = mesh.colors[i][3] / 255.0;
          strong += opacity > 0.9;
          faint += opacity < 0.1;
          if (from_trunk(p) > 0.08) CHECK(opacity < 0.1);
          if (opacity < 0.9 || from_trunk(p) < seen) continue;
          const double turns = mesh.uvs[i].x / repeats - on_trunk(p).x;
          u.push_back(turns - std::round(turns - (u.empty() ? turns : u.front())));
          v.push_back(mesh.uvs[i].y / repeats - on_trunk(p).y);
        }
        REQUIRE(strong > 4);
        CHECK(faint > 4);
        CHECK(*std::max_element(u.begin(), u.end()) - *std::min_element(u.begin(), u.end()) < 0.05);
        CHECK(*std::max_element(v.begin(), v.end()) - *std::min_element(v.begin(), v.end()) < 0.05);
        check_open_edges(mesh, *overlay);
        for (std::size_t t = overlay->first_triangle; t < mesh.triangles.size(); ++t) {
          const auto& [a, b, c] = mesh.triangles[t];
          const auto is_seen = [&](std::uint32_t at) { return from_trunk(mesh.positions[at]) > seen; };
          if (!is_seen(a) || !is_seen(b) || !is_seen(c)) continue;
          const auto [low, high] = std::minmax({mesh.uvs[a].x, mesh.uvs[b].x, mesh.uvs[c].x});
          CHECK(high - low < 0.5f * repeats);  // else it runs across the texture's ends
        }
      }
    }
  }
}

TEST_CASE("joints: a lateral meets what has run along its bearer from farther down") {
  for (const double away : {0.1, 0.4}) {
    Skeleton tree;
    for (std::uint32_t i = 0; i <= 6; ++i)
      add_node(tree, {0, 0.5 * i, 0}, i == 0 ? kNoParent : i - 1, kTrunk);
    for (std::uint32_t i = 1; i <= 4; ++i) add_node(tree, {away, 1.0 + 0.4 * i, 0}, i == 1 ? 2 : 5 + i, 0.2);
    for (std::uint32_t i = 1; i <= 2; ++i) add_node(tree, {0, 2.0, 0.4 * i}, i == 1 ? 4 : 9 + i, 0.2);
    assign_axes(tree);
    const std::vector<Joint> joints = find_joints(tree);
    const auto has = [&](std::uint32_t lateral, std::uint32_t older) {
      return std::ranges::any_of(
          joints, [&](const Joint& joint) { return joint.lateral == lateral && joint.older == older; });
    };
    CHECK(has(7, 2));
    CHECK(has(11, 4));
    CHECK(has(11, 8) == (away < 0.3));  // where the first one comes by
    CHECK(joints.size() == (away < 0.3 ? 3 : 2));
  }
}

TEST_CASE("fork bark: a bearer that is bent at the fork goes on in its own width of bark") {
  Skeleton tree;
  // The lateral leaves a short internode aslant and runs up along the trunk, of which it comes out little by
  // little.
  const std::vector<Vec3> trunk = {{0, 0, 0},      {0, 0.5, 0}, {0, 0.8, 0}, {0.12, 0.95, 0},
                                   {0.04, 1.2, 0}, {0, 1.7, 0}, {0, 2.2, 0}};
  for (std::uint32_t i = 0; i < trunk.size(); ++i)
    add_node(tree, trunk[i], i == 0 ? kNoParent : i - 1, kTrunk);
  const std::vector<Vec3> lateral = {{0.12, 1.2, 0.03}, {0.1, 1.5, 0.04}, {0.2, 1.8, 0.2}, {0.4, 2.0, 0.5}};
  for (std::uint32_t i = 0; i < lateral.size(); ++i)
    add_node(tree, lateral[i], i == 0 ? 3 : 6 + i, 0.8 * kTrunk);
  assign_axes(tree);
  for (const MeshMethod method : {MeshMethod::smooth, MeshMethod::watertight}) {
    Looks looks = looks_with(method);
    looks.mesher.voxel_size = 0.02;
    const Mesh mesh = mesh_of(tree, looks);
    const MaterialRange* overlay = overlay_of(mesh);
    REQUIRE(overlay != nullptr);
    const double a_metre = bark_repeats(tree, looks.bark.tile_width)[3] / (std::numbers::pi * kTrunk);
    double whole = 0.0;  // of edges, metres
    double squeezed = 0.0;
    for (std::size_t t = overlay->first_triangle; t < mesh.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = mesh.triangles[t][i];
        const std::uint32_t b = mesh.triangles[t][(i + 1) % 3];
        const double length = glm::distance(mesh.positions[a], mesh.positions[b]);
        if (std::min(mesh.colors[a][3], mesh.colors[b][3]) < 128 || length < 0.005) continue;
        const double texture = glm::distance(mesh.uvs[a], mesh.uvs[b]) / a_metre;
        whole += length;
        if (texture > 1.6 * length) squeezed += length;
      }
    }
    INFO(static_cast<int>(method));
    CHECK(whole > 1.0);
    CHECK(squeezed < 0.02 * whole);
  }
}

TEST_CASE("fork bark: on any tree no triangle goes round more than once") {
  std::size_t triangles = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    for (const Looks& looks : {looks_with(MeshMethod::smooth), looks_with(MeshMethod::cones),
                               looks_with(MeshMethod::smooth, CentreLine::catmull_rom)}) {
      const Mesh mesh = mesh_of(random_tree(seed, 80), looks);
      const MaterialRange* overlay = overlay_of(mesh);
      if (overlay == nullptr) continue;
      triangles += overlay->triangle_count;
      for (std::size_t t = overlay->first_triangle; t < mesh.triangles.size(); ++t) {
        float low = std::numeric_limits<float>::infinity();
        float high = -low;
        for (const std::uint32_t v : mesh.triangles[t]) {
          CHECK(std::isfinite(mesh.uvs[v].x + mesh.uvs[v].y));
          low = std::min(low, mesh.uvs[v].x);
          high = std::max(high, mesh.uvs[v].x);
        }
        CHECK(high - low <= most_around(mesh));
      }
    }
  }
  CHECK(triangles > 500);
}

TEST_CASE("fork bark: it fades out evenly where a side goes straight out, without vertices on the way") {
  const float fade = 0.6f * 0.075f;
  for (const MeshMethod method : {MeshMethod::smooth, MeshMethod::cones}) {
    const Mesh mesh = mesh_of(fork(90.0, 0.15), looks_with(method));
    const MaterialRange* overlay = overlay_of(mesh);
    REQUIRE(overlay != nullptr);
    INFO(static_cast<int>(method));
    std::size_t coarse = 0;
    for (std::size_t t = overlay->first_triangle; t < mesh.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = mesh.triangles[t][i];
        const std::uint32_t b = mesh.triangles[t][(i + 1) % 3];
        const bool is_steep = std::abs(mesh.colors[a][3] - mesh.colors[b][3]) > 140;
        coarse += is_steep && glm::distance(mesh.positions[a], mesh.positions[b]) > 2.1f * fade;
      }
    }
    CHECK(coarse == 0);
    // Its new vertices lie on the surface.
    const std::size_t solid = solid_part(mesh).triangle_count;
    std::vector<std::uint32_t> all(solid);
    std::iota(all.begin(), all.end(), 0u);
    const TriangleTree surface(mesh, all);
    for (std::size_t v = solid_part(mesh).vertex_count; v < mesh.vertex_count(); ++v) {
      CHECK(surface.nearest(mesh.positions[v]).distance2 < 0.001f * 0.001f);
      CHECK(glm::length(mesh.normals[v]) == Approx(1.0f));
    }
  }
}

TEST_CASE("fork bark: where a thick lateral comes out of the trunk, nothing of its own bark is seen") {
  for (const MeshMethod method : {MeshMethod::smooth, MeshMethod::cones}) {
    for (const double angle : {35.0, 60.0, 90.0}) {
      const Mesh mesh = mesh_of(fork(angle, 0.15, 100.0), looks_with(method));
      const MaterialRange* overlay = overlay_of(mesh);
      REQUIRE(overlay != nullptr);
      INFO(static_cast<int>(method) << ", " << angle << " degrees");
      std::vector<std::uint32_t> trunk;
      for (std::uint32_t t = 0; t < overlay->first_triangle; ++t) {
        if (mesh.internodes[mesh.triangles[t][0]] <= kTrunkNodes) trunk.push_back(t);
      }
      const TriangleTree surface(mesh, trunk);
      const auto outside = [&](const Vec3f& p) {  // metres, where the trunk's sides are flat
        const NearestTriangle nearest = surface.nearest(p);
        return std::copysign(std::sqrt(nearest.distance2), from_trunk(p) - from_trunk(nearest.point));
      };
      constexpr double kHidden = -0.006;  // metres: 12 sides lie 0.005 farther in
      std::size_t ways_out = 0;
      std::size_t hidden = 0;
      double faintest = 1.0;
      for (std::size_t t = overlay->first_triangle; t < mesh.triangles.size(); ++t) {
        const Triangle& corners = mesh.triangles[t];
        const auto is_hidden = [&](std::uint32_t v) { return from_trunk(mesh.positions[v]) < kHidden; };
        hidden += std::ranges::all_of(corners, is_hidden);
        for (std::size_t i = 0; i < 3; ++i) {
          const std::uint32_t a = corners[i];
          const std::uint32_t b = corners[(i + 1) % 3];
          const double from = outside(mesh.positions[a]);
          const double to = outside(mesh.positions[b]);
          if (from >= 0.0 || to <= 0.0 || (is_hidden(a) && is_hidden(b))) continue;
          ++ways_out;
          const double opacity =
              std::lerp(mesh.colors[a][3] / 255.0, mesh.colors[b][3] / 255.0, from / (from - to));
          faintest = std::min(faintest, opacity);
        }
      }
      CHECK(hidden == 0);
      CHECK(ways_out > 10);
      CHECK(faintest > 0.88);
    }
  }
}

TEST_CASE("fork bark: on a closed surface it begins on the bearer's, without an edge, and fades out evenly") {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    // Limbs about as thick as the trunk, which part within its width.
    Rng random = Rng::stream(seed, Stream::bud, 0);
    Skeleton tree;
    for (std::uint32_t i = 0; i <= 3; ++i) add_node(tree, {0, 0.3 * i, 0}, i == 0 ? kNoParent : i - 1, 0.3);
    for (std::uint32_t limb = 0; limb < 4; ++limb) {
      const std::uint32_t from = limb < 2 ? 2 : 3;
      const double lean = radians(random.uniform(20.0, 80.0));
      const double azimuth = radians(random.uniform(0.0, 360.0));
      const Vec3 along(std::sin(lean) * std::cos(azimuth), std::cos(lean),
                       std::sin(lean) * std::sin(azimuth));
      for (std::uint32_t i = 1; i <= 3; ++i) {
        const auto last = static_cast<std::uint32_t>(tree.node_count() - 1);
        add_node(tree, tree.position[from] + 0.25 * i * along, i == 1 ? from : last, 0.28);
      }
    }
    assign_axes(tree);
    Looks looks = looks_with(MeshMethod::watertight);
    looks.mesher.voxel_size = 0.01;
    const Mesh mesh = mesh_of(tree, looks);
    const MaterialRange* overlay = overlay_of(mesh);
    REQUIRE(overlay != nullptr);
    const auto place = [&](std::uint32_t v) {
      const Vec3f& p = mesh.positions[v];
      return std::tuple(p.x, p.y, p.z);
    };
    std::set<decltype(place(0))> solid;
    for (std::uint32_t v = 0; v < solid_part(mesh).vertex_count; ++v) solid.insert(place(v));
    std::size_t begins = 0;
    double steepest = 0.0;
    for (std::size_t t = overlay->first_triangle; t < mesh.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh.triangles[t][k];
        const std::uint32_t b = mesh.triangles[t][(k + 1) % 3];
        begins += solid.contains(place(a));
        const double change = std::abs(mesh.colors[a][3] - mesh.colors[b][3]) / 255.0 - 0.01;
        steepest =
            std::max(steepest, change * 0.6 * 0.14 / glm::distance(mesh.positions[a], mesh.positions[b]));
      }
    }
    INFO("seed " << seed);
    CHECK(begins > 500);
    // A smooth step rises by 1.5 at the most; against stretch it goes three times as quickly. Half
    // of that more was seen at the most; tens where vertices of the same limb count as inside and outside.
    CHECK(steepest < 1.5 * 1.5 * 3.0);
  }
}

TEST_CASE("fork bark: none where no image is, on coarse levels and within a budget") {
  const Skeleton tree = fork(60.0, 0.15);
  CHECK(overlay_of(mesh_of(tree, looks_with(MeshMethod::smooth))) != nullptr);
  CHECK(overlay_of(mesh_of(fork(60.0, 0.002), looks_with(MeshMethod::smooth))) == nullptr);  // a twig
  CHECK(overlay_of(mesh_of(pole(5), looks_with(MeshMethod::smooth))) == nullptr);
  Looks looks = looks_with(MeshMethod::smooth);
  looks.bark.kind = BarkKind::plain;
  CHECK(overlay_of(mesh_of(tree, looks)) == nullptr);
  looks = looks_with(MeshMethod::smooth);
  looks.mesher.lod = 1;
  CHECK(overlay_of(mesh_of(tree, looks)) == nullptr);
  looks.mesher.lod = 0;
  looks.mesher.max_triangles = 1000;
  CHECK(mesh_of(tree, looks).triangles.size() <= 1000);
  looks.mesher.max_triangles = 0;
  looks.mesher.color_by = "order";
  CHECK(overlay_of(mesh_of(tree, looks)) == nullptr);
}

TEST_CASE("fork bark: the same for any number of threads") {
  const Skeleton tree = random_tree(7, 500);
  const Mesh mesh = mesh_of(tree, looks_with(MeshMethod::smooth));
  REQUIRE(overlay_of(mesh) != nullptr);
  const ThreadLimit limit(1);
  CHECK(is_same(mesh_of(tree, looks_with(MeshMethod::smooth)), mesh));
}

TEST_CASE("fork bark: the rest of the mesh is what it is without") {
  const Skeleton tree = fork(60.0, 0.15);
  Looks looks = looks_with(MeshMethod::smooth);
  looks.leaves.shape = LeafShape::ovate;
  looks.leaves.max_width = 1.0;
  const Mesh mesh = mesh_of(tree, looks);
  const SolidPart solid = solid_part(mesh);
  const Mesh wood = build_mesh(tree, looks.mesher);
  REQUIRE(solid.vertex_count > wood.vertex_count());  // leaves
  CHECK(std::equal(wood.positions.begin(), wood.positions.end(), mesh.positions.begin()));
  CHECK(std::equal(wood.triangles.begin(), wood.triangles.end(), mesh.triangles.begin()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t])
      CHECK((v < solid.vertex_count) == (t < solid.triangle_count));
  }
  for (std::size_t v = 0; v < solid.vertex_count; ++v) CHECK(mesh.colors[v][3] == 255);

  // Leaves have no tangents: the overlay's follow those of the wood.
  const std::size_t overlay = mesh.vertex_count() - solid.vertex_count;
  REQUIRE(mesh.tangents.size() == wood.vertex_count() + overlay);
  for (std::size_t i = 0; i < overlay; ++i) {
    const Vec3f tangent(mesh.tangents[wood.vertex_count() + i]);
    CHECK(glm::dot(tangent, mesh.normals[solid.vertex_count + i]) == Approx(0.0f).margin(1e-4));
  }
}

TEST_CASE(
    "fork bark: a glTF blends it over the bark, with the bark's own images, other formats leave it out") {
  const Mesh mesh = mesh_of(fork(60.0, 0.15), looks_with(MeshMethod::smooth));
  const SolidPart solid = solid_part(mesh);
  REQUIRE(overlay_of(mesh) != nullptr);
  std::ostringstream gltf;
  write_gltf(mesh, {}, GltfForm::text, gltf);
  nlohmann::json json = nlohmann::json::parse(gltf.str());
  REQUIRE(json["materials"].size() == 2);
  CHECK(json["materials"][1]["name"] == kForkBark);
  CHECK(json["materials"][1]["alphaMode"] == "BLEND");
  CHECK(json["materials"][1]["normalTexture"] == json["materials"][0]["normalTexture"]);
  CHECK(json["images"].size() == 2);
  CHECK(json["meshes"][0]["primitives"][1]["attributes"].contains("COLOR_0"));
  CHECK(json["meshes"][0]["primitives"][1]["attributes"].contains("TANGENT"));

  const Mesh again = read_gltf(gltf.str(), "a");
  REQUIRE(overlay_of(again) != nullptr);
  CHECK(solid_part(again).vertex_count == solid.vertex_count);
  CHECK(again.positions == mesh.positions);
  CHECK(again.triangles == mesh.triangles);
  CHECK(again.colors == mesh.colors);

  // Another program has turned the order round: now it would be written as a surface, with holes in its
  // picture.
  auto& primitives = json["meshes"][0]["primitives"];
  std::swap(primitives[0], primitives[1]);
  const Mesh turned = read_gltf(json.dump(), "a");
  CHECK(overlay_of(turned) == nullptr);
  CHECK(solid_part(turned).triangle_count == mesh.triangles.size());

  std::ostringstream obj;
  std::ostringstream materials;
  write_obj(mesh, {}, "a.mtl", obj);
  write_mtl(mesh, "a", materials);
  CHECK(obj.str().find(kForkBark) == std::string::npos);
  CHECK(materials.str().find(kForkBark) == std::string::npos);
  CHECK(image_files(mesh, "a").size() == 2);
  const std::string text = obj.str();
  const auto lines = [&](const std::string& start) {
    std::size_t count = 0;
    for (std::size_t at = text.find(start); at != std::string::npos; at = text.find(start, at + 1)) ++count;
    return count;
  };
  CHECK(lines("\nv ") == solid.vertex_count);
  CHECK(lines("\nvt ") == solid.vertex_count);
  CHECK(lines("\nvn ") == solid.vertex_count);
  CHECK(lines("\nf ") == solid.triangle_count);
  std::ostringstream ply;
  write_ply(mesh, {}, ply);
  CHECK(ply.str().find("element vertex " + std::to_string(solid.vertex_count) + "\n") != std::string::npos);
  const std::size_t body = ply.str().find("end_header\n") + 11;
  CHECK(ply.str().size() - body == 40 * solid.vertex_count + 13 * solid.triangle_count);
  std::ostringstream stl;
  write_stl(mesh, {}, stl);
  CHECK(stl.str().size() == 84 + 50 * solid.triangle_count);
}
