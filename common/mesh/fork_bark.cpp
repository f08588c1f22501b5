#include "common/mesh/fork_bark.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/parallel.h"
#include "common/mesh/bark_stretches.h"
#include "common/mesh/joints.h"
#include "common/mesh/nearest_triangle.h"

namespace ramify {
namespace {

// In radii of the lateral: so far from its bearer's surface the bearer's bark has faded out.
constexpr float kFade = 0.6f;

// What fades out does so over triangles shorter than this, in fades: else there is no collar.
constexpr float kLongest = 4.0f;

// Where a lateral goes straight out, the bearer's bark is stretched along it: what is missing of it then
// counts so often towards the fade.
constexpr float kAgainstStretch = 2.0f;

// In radii of the lateral: how far above its surface.
constexpr float kAbove = 0.004f;

// Cosine between a surface's normal and the way to a point below which that lies inside.
constexpr float kInside = -0.7f;

/// The bark's triangles of some internodes.
class TrianglesOfNodes {
 public:
  TrianglesOfNodes(const Mesh& mesh, const MaterialRange& bark, std::size_t node_count,
                   const std::vector<Joint>& joints)
      : begin_(node_count + 1, 0) {
    std::vector<bool> is_wanted(node_count, false);
    for (const Joint& joint : joints) {
      for (const std::uint32_t node : joint.lateral_nodes) is_wanted[node] = true;
      for (const std::uint32_t node : joint.older_nodes) is_wanted[node] = true;
    }
    const std::size_t end = bark.first_triangle + bark.triangle_count;
    const auto node_of = [&](std::size_t t) { return mesh.internodes[mesh.triangles[t][0]]; };
    for (std::size_t t = bark.first_triangle; t < end; ++t) {
      if (is_wanted[node_of(t)]) ++begin_[node_of(t) + 1];
    }
    for (std::size_t node = 0; node < node_count; ++node) begin_[node + 1] += begin_[node];
    list_.resize(begin_.back());
    std::vector<std::uint32_t> filled(begin_.begin(), begin_.end() - 1);
    for (std::size_t t = bark.first_triangle; t < end; ++t) {
      if (is_wanted[node_of(t)]) list_[filled[node_of(t)]++] = static_cast<std::uint32_t>(t);
    }
  }

  std::vector<std::uint32_t> of(const std::vector<std::uint32_t>& nodes) const {
    std::vector<std::uint32_t> triangles;
    for (const std::uint32_t node : nodes)
      triangles.insert(triangles.end(), list_.begin() + begin_[node], list_.begin() + begin_[node + 1]);
    return triangles;
  }

 private:
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> list_;
};

/// How the bearer's bark lies on one vertex of a lateral.
struct Cover {
  Vec2f uv{0.0f};
  float distance = 0.0f;  // from the bearer's surface, metres; negative inside
  float opacity = 0.0f;
};

/// A part of the overlay: vertices like those of the mesh, of which they are copies.
struct Patch {
  std::vector<std::uint32_t> vertices;
  std::vector<Vec2f> uvs;
  std::vector<float> opacities;
  std::vector<Triangle> triangles;  // indices into these
};

class PatchMaker {
 public:
  PatchMaker(const Mesh& mesh, const Skeleton& skeleton, const BarkStretches& stretches, const Joint& joint,
             float repeats)
      : mesh_(mesh),
        skeleton_(skeleton),
        stretches_(stretches),
        joint_(joint),
        repeats_(repeats),
        fade_(kFade * joint.radius) {}

  Patch make(const std::vector<std::uint32_t>& bearer, const std::vector<std::uint32_t>& lateral) {
    if (bearer.empty()) return {};
    cover(TriangleTree(mesh_, bearer), lateral);
    bare_long_triangles(lateral);
    Patch patch;
    for (const std::uint32_t t : lateral) {
      const Triangle& triangle = mesh_.triangles[t];
      const auto is_bare = [&](std::uint32_t v) { return covers_.at(v).opacity <= 0.0f; };
      const auto is_inside = [&](std::uint32_t v) { return covers_.at(v).distance < 0.0f; };
      if (std::all_of(triangle.begin(), triangle.end(), is_bare)) continue;
      if (std::all_of(triangle.begin(), triangle.end(), is_inside)) continue;
      add(triangle, patch);
    }
    return patch;
  }

 private:
  void cover(const TriangleTree& bearer, const std::vector<std::uint32_t>& lateral) {
    for (const std::uint32_t t : lateral) {
      for (const std::uint32_t v : mesh_.triangles[t]) {
        const auto [found, is_new] = covers_.try_emplace(v);
        if (is_new) found->second = cover_at(bearer, mesh_.positions[v]);
      }
    }
  }

  Cover cover_at(const TriangleTree& bearer, const Vec3f& point) const {
    const NearestTriangle nearest = bearer.nearest(point);
    const auto [a, b, c] = mesh_.triangles[nearest.triangle];
    const Vec3f& shares = nearest.shares;
    Cover cover;
    cover.uv = mesh_.uvs[a] * shares.x + mesh_.uvs[b] * shares.y + mesh_.uvs[c] * shares.z;
    const Vec2f girths = beyond(mesh_.internodes[a], nearest.point, point);
    cover.uv += girths * repeats_;
    const Vec3f normal =
        mesh_.normals[a] * shares.x + mesh_.normals[b] * shares.y + mesh_.normals[c] * shares.z;
    cover.distance = std::sqrt(nearest.distance2);
    const float girth = 2.0f * std::numbers::pi_v<float> * joint_.older_radius;
    const float missing = std::max(cover.distance - glm::length(girths) * girth, 0.0f);
    // At a closed surface's border with the lateral it goes on to both sides.
    if (glm::dot(point - nearest.point, normal) < kInside * cover.distance) cover.distance *= -1.0f;
    const float from_fork = glm::distance(point, Vec3f(skeleton_.position[skeleton_.parent[joint_.lateral]]));
    cover.opacity = (1.0f - glm::smoothstep(0.0f, fade_, cover.distance + kAgainstStretch * missing)) *
                    (1.0f - glm::smoothstep(0.6f * joint_.reach, joint_.reach, from_fork));
    return cover;
  }

  /// How far the bearer's chart goes on from a point of its surface, at an internode, to another: in girths.
  Vec2f beyond(std::uint32_t internode, const Vec3f& from, const Vec3f& to) const {
    Vec2f girths = stretches_.uv(internode, Vec3(to)) - stretches_.uv(internode, Vec3(from));
    girths.x -= std::round(girths.x);  // the shorter way around
    return girths;
  }

  /// A side that goes out straight, without rings that follow one another, shows its own bark.
  void bare_long_triangles(const std::vector<std::uint32_t>& lateral) {
    std::vector<std::uint32_t> bare;
    for (const std::uint32_t t : lateral) {
      const auto& [a, b, c] = mesh_.triangles[t];
      const auto [low, high] =
          std::minmax({covers_.at(a).distance, covers_.at(b).distance, covers_.at(c).distance});
      if (low < fade_ && high - low > kLongest * fade_) bare.insert(bare.end(), {a, b, c});
    }
    for (const std::uint32_t v : bare) covers_.at(v).opacity = 0.0f;
  }

  void add(const Triangle& triangle, Patch& patch) {
    Triangle copy{};
    const float first_u = covers_.at(triangle[0]).uv.x;
    for (std::size_t i = 0; i < 3; ++i) {
      const Cover& cover = covers_.at(triangle[i]);
      // Behind, where the texture's ends meet, it is a turn further.
      const int turns = static_cast<int>(std::lround((first_u - cover.uv.x) / repeats_));
      const auto [found, is_new] =
          copies_.try_emplace({triangle[i], turns}, static_cast<std::uint32_t>(patch.vertices.size()));
      copy[i] = found->second;
      if (!is_new) continue;
      patch.vertices.push_back(triangle[i]);
      patch.uvs.emplace_back(cover.uv.x + static_cast<float>(turns) * repeats_, cover.uv.y);
      patch.opacities.push_back(cover.opacity);
    }
    patch.triangles.push_back(copy);
  }

  const Mesh& mesh_;
  const Skeleton& skeleton_;
  const BarkStretches& stretches_;
  const Joint& joint_;
  const float repeats_;
  const float fade_;
  std::map<std::uint32_t, Cover> covers_;                          // of the lateral's vertices
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> copies_;  // of vertices, by the turns added to u
};

/// Makes room for all of them first: the arrays of a large tree are moved once.
void append_patches(Mesh& mesh, const std::vector<Joint>& joints, const std::vector<Patch>& patches) {
  std::size_t vertex = mesh.vertex_count();
  std::size_t triangle = mesh.triangles.size();
  std::size_t vertices = vertex;
  std::size_t triangles = triangle;
  for (const Patch& patch : patches) {
    vertices += patch.vertices.size();
    triangles += patch.triangles.size();
  }
  if (triangles == triangle) return;
  if (mesh.colors.empty()) mesh.colors.resize(vertex, {255, 255, 255, 255});
  mesh.positions.resize(vertices);
  mesh.normals.resize(vertices);
  mesh.uvs.resize(vertices);
  mesh.colors.resize(vertices);
  mesh.internodes.resize(vertices);
  mesh.triangles.resize(triangles);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const auto base = static_cast<std::uint32_t>(vertex);
    for (std::size_t v = 0; v < patches[i].vertices.size(); ++v, ++vertex) {
      const std::uint32_t source = patches[i].vertices[v];
      mesh.normals[vertex] = mesh.normals[source];
      mesh.positions[vertex] = mesh.positions[source] + mesh.normals[source] * (kAbove * joints[i].radius);
      mesh.uvs[vertex] = patches[i].uvs[v];
      mesh.colors[vertex] = mesh.colors[source];
      mesh.colors[vertex][3] = static_cast<std::uint8_t>(255.0f * patches[i].opacities[v] + 0.5f);
      mesh.internodes[vertex] = joints[i].older;
    }
    for (const auto& [a, b, c] : patches[i].triangles)
      mesh.triangles[triangle++] = {base + a, base + b, base + c};
  }
}

}  // namespace

void append_fork_bark(Mesh& mesh, const Skeleton& skeleton, std::span<const float> repeats) {
  const auto is_bark = [&](const MaterialRange& range) { return mesh.material(range).name == "bark"; };
  const auto bark = std::find_if(mesh.ranges.begin(), mesh.ranges.end(), is_bark);
  if (bark == mesh.ranges.end() || mesh.material(*bark).image.is_empty()) return;

  const std::vector<Joint> joints = find_joints(skeleton);
  const TrianglesOfNodes triangles(mesh, *bark, skeleton.node_count(), joints);
  const BarkStretches stretches(skeleton);
  std::vector<Patch> patches(joints.size());
  parallel_for(joints.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Joint& joint = joints[i];
      patches[i] = PatchMaker(mesh, skeleton, stretches, joint, repeats[joint.older])
                       .make(triangles.of(joint.older_nodes), triangles.of(joint.lateral_nodes));
    }
  });

  const std::size_t first_triangle = mesh.triangles.size();
  append_patches(mesh, joints, patches);
  if (mesh.triangles.size() == first_triangle) return;
  Material overlay = mesh.material(*bark);
  overlay.name = kForkBark;
  overlay.is_overlay = true;
  mesh.ranges.push_back({mesh.materials.size(), first_triangle, mesh.triangles.size() - first_triangle});
  mesh.materials.push_back(std::move(overlay));
}

}  // namespace ramify
