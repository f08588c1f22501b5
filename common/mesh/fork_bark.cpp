#include "common/mesh/fork_bark.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/parallel.h"
#include "common/mesh/bark_stretches.h"
#include "common/mesh/joints.h"
#include "common/mesh/nearest_triangle.h"
#include "common/mesh/refinement.h"
#include "common/mesh/wood.h"

namespace ramify {
namespace {

// In radii of the lateral: so far from its bearer's surface the bearer's bark has faded out.
constexpr float kFade = 0.6f;

// Between vertices that are farther apart than so many fades the opacity changes by no more than this.
constexpr float kLongest = 2.0f;
constexpr float kOpacityStep = 0.5f;

// Where a lateral comes out of its bearer the opacity is no less than this, but edges of so many fades are
// not halved for it. In widths of the thickest wood: thinner laterals are not worth the triangles.
constexpr float kCovers = 0.9f;
constexpr float kShortest = 0.2f;
constexpr float kThick = 0.1f;

// Times that the overlay is refined at the most: triangles without area could be for ever.
constexpr int kRefinements = 14;

// Where a lateral goes straight out, the bearer's bark is stretched along it: what is missing of it then
// counts so often towards the fade.
constexpr float kAgainstStretch = 2.0f;

// In radii of the lateral: how far above its surface, but no farther than from the bearer's: where a closed
// surface goes on from one to the other, an edge would stand out.
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

/// How the bearer's bark lies at a point of the lateral.
struct Cover {
  Vec2f uv{0.0f};
  float distance = 0.0f;  // from the bearer's surface, metres; negative inside
  float opacity = 0.0f;
};

/// Of the lateral's surface.
struct SurfaceVertex {
  Vec3f position;
  Vec3f normal;
  glm::vec4 color;  // 0 to 255, as in the mesh
};

SurfaceVertex halfway(const SurfaceVertex& a, const SurfaceVertex& b) {
  return {0.5f * (a.position + b.position), normalized_or(a.normal + b.normal, a.normal, 1e-6f),
          0.5f * (a.color + b.color)};
}

/// A part of the overlay.
struct Patch {
  std::vector<SurfaceVertex> vertices;  // their alpha is the opacity
  std::vector<Vec2f> uvs;
  std::vector<Triangle> triangles;  // indices into these
};

/// What all patches are made of.
struct Tree {
  const Mesh& mesh;
  const Skeleton& skeleton;
  const MesherOptions& options;
  BarkStretches stretches;
  double thickest = 0.0;  // diameter, metres
};

class PatchMaker {
 public:
  PatchMaker(const Tree& tree, const Joint& joint, float repeats, const std::vector<std::uint32_t>& bearer)
      : mesh_(tree.mesh),
        skeleton_(tree.skeleton),
        stretches_(tree.stretches),
        joint_(joint),
        repeats_(repeats),
        method_(tree.options.method),
        fade_(kFade * joint.radius),
        is_thick_(2.0 * joint.radius >= kThick * tree.thickest),
        apothem_(
            std::cos(std::numbers::pi / side_count(2.0 * joint.older_radius, tree.thickest, tree.options))),
        bearer_(tree.mesh, bearer) {}

  Patch make(const std::vector<std::uint32_t>& lateral) {
    cover(lateral);
    refine_triangles();
    for (const Triangle& triangle : triangles_) {
      if (is_seen(triangle)) add(triangle);
    }
    return std::move(patch_);
  }

 private:
  /// All triangles of the lateral: on what is bare at its corners the bark may be seen between them.
  void cover(const std::vector<std::uint32_t>& lateral) {
    std::map<std::uint32_t, std::uint32_t> places;  // of the mesh's vertices among these
    for (const std::uint32_t t : lateral) {
      Triangle triangle{};
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = mesh_.triangles[t][i];
        const auto [found, is_new] = places.try_emplace(v, static_cast<std::uint32_t>(vertices_.size()));
        triangle[i] = found->second;
        if (is_new) add_vertex({mesh_.positions[v], mesh_.normals[v], color_of(v)});
      }
      triangles_.push_back(triangle);
    }
  }

  glm::vec4 color_of(std::uint32_t vertex) const {
    if (mesh_.colors.empty()) return glm::vec4(255.0f);
    const auto [r, g, b, alpha] = mesh_.colors[vertex];
    return {r, g, b, alpha};
  }

  std::uint32_t add_vertex(const SurfaceVertex& vertex) {
    vertices_.push_back(vertex);
    covers_.push_back(cover_at(vertex.position));
    return static_cast<std::uint32_t>(vertices_.size() - 1);
  }

  bool is_seen(const Triangle& triangle) const {
    const auto is_bare = [&](std::uint32_t v) { return covers_[v].opacity <= 0.0f; };
    const auto is_inside = [&](std::uint32_t v) { return covers_[v].distance < 0.0f; };
    return !std::ranges::all_of(triangle, is_bare) && !std::ranges::all_of(triangle, is_inside);
  }

  Cover cover_at(const Vec3f& point) const {
    const NearestTriangle nearest = bearer_.nearest(point);
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
    float missing = std::max(cover.distance - glm::length(girths) * girth, 0.0f);
    if (is_inside(point, glm::dot(point - nearest.point, normal), cover.distance)) {
      cover.distance *= -1.0f;
      missing = 0.0f;
    }
    const float from_fork = glm::distance(point, Vec3f(skeleton_.position[skeleton_.parent[joint_.lateral]]));
    cover.opacity = (1.0f - glm::smoothstep(0.0f, fade_, cover.distance + kAgainstStretch * missing)) *
                    (1.0f - glm::smoothstep(0.6f * joint_.reach, joint_.reach, from_fork));
    return cover;
  }

  /// Of a point so far from the bearer's surface, and so far along the normal there: whether in the bearer.
  bool is_inside(const Vec3f& point, float along_normal, float distance) const {
    // Behind the border of a part of a closed surface one is not inside.
    if (method_ == MeshMethod::watertight) return false;
    if (along_normal < kInside * distance) return true;
    // What comes out of a node's sphere may still be within a cone.
    return method_ == MeshMethod::cones && std::ranges::any_of(joint_.older_nodes, [&](std::uint32_t node) {
             return is_in_cone(point, node);
           });
  }

  bool is_in_cone(const Vec3f& point, std::uint32_t node) const {
    if (skeleton_.is_root(node)) return false;
    const Vec3 base = skeleton_.position[skeleton_.parent[node]];
    const Vec3 along = skeleton_.position[node] - base;
    const Vec3 from_base = Vec3(point) - base;
    const double share = glm::dot(from_base, along) / std::max(glm::dot(along, along), 1e-12);
    return glm::distance(from_base, std::clamp(share, 0.0, 1.0) * along) <
           apothem_ * 0.5 * skeleton_.diameter[node];
  }

  /// How far the bearer's chart goes on from a point of its surface, at an internode, to another: in girths.
  Vec2f beyond(std::uint32_t internode, const Vec3f& from, const Vec3f& to) const {
    Vec2f girths = stretches_.uv(internode, Vec3(to)) - stretches_.uv(internode, Vec3(from));
    girths.x -= std::round(girths.x);  // the shorter way around
    return girths;
  }

  float length(const Edge& edge) const {
    return glm::distance(vertices_[edge.first].position, vertices_[edge.second].position);
  }

  /// Whether opacity, which changes evenly along an edge, does so by much over a long way, or where the edge
  /// comes out of the bearer it is low or the bark's place may be wrong.
  bool is_coarse(const Edge& edge) const {
    const Cover& a = covers_[edge.first];
    const Cover& b = covers_[edge.second];
    const bool comes_out = (a.distance < 0.0f) != (b.distance < 0.0f);
    if (length(edge) > kLongest * fade_) return comes_out || std::abs(a.opacity - b.opacity) > kOpacityStep;
    if (!comes_out || !is_thick_ || length(edge) <= kShortest * fade_) return false;
    const float way_out = a.distance / (a.distance - b.distance);
    return std::lerp(a.opacity, b.opacity, way_out) < kCovers;
  }

  /// Adds vertices where the lateral's own are too far apart for the bark to fade out between them.
  void refine_triangles() {
    const EdgeRules rules{
        .is_coarse = [&](const Edge& edge) { return is_coarse(edge); },
        .length = [&](const Edge& edge) { return length(edge); },
        .add_middle =
            [&](const Edge& edge) {
              return add_vertex(halfway(vertices_[edge.first], vertices_[edge.second]));
            },
    };
    for (int i = 0; i < kRefinements && refine(triangles_, rules); ++i) {
    }
  }

  void add(const Triangle& triangle) {
    Triangle copy{};
    const float first_u = covers_[triangle[0]].uv.x;
    for (std::size_t i = 0; i < 3; ++i) {
      const Cover& cover = covers_[triangle[i]];
      // Behind, where the texture's ends meet, it is a turn further.
      const int turns = static_cast<int>(std::lround((first_u - cover.uv.x) / repeats_));
      const auto [found, is_new] =
          copies_.try_emplace({triangle[i], turns}, static_cast<std::uint32_t>(patch_.vertices.size()));
      copy[i] = found->second;
      if (!is_new) continue;
      SurfaceVertex& vertex = patch_.vertices.emplace_back(vertices_[triangle[i]]);
      vertex.position += vertex.normal * std::min(kAbove * joint_.radius, std::abs(cover.distance));
      vertex.color.a = 255.0f * cover.opacity;
      patch_.uvs.emplace_back(cover.uv.x + static_cast<float>(turns) * repeats_, cover.uv.y);
    }
    patch_.triangles.push_back(copy);
  }

  const Mesh& mesh_;
  const Skeleton& skeleton_;
  const BarkStretches& stretches_;
  const Joint& joint_;
  const float repeats_;
  const MeshMethod method_;
  const float fade_;
  const bool is_thick_;
  const double apothem_;  // of a cone of the bearer, in its radii: to the middle of a side
  const TriangleTree bearer_;
  std::vector<SurfaceVertex> vertices_;
  std::vector<Cover> covers_;  // of these
  std::vector<Triangle> triangles_;
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> copies_;  // of vertices, by the turns added to u
  Patch patch_;
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
      const auto& [position, normal, color] = patches[i].vertices[v];
      mesh.positions[vertex] = position;
      mesh.normals[vertex] = normal;
      mesh.uvs[vertex] = patches[i].uvs[v];
      for (int part = 0; part < 4; ++part)
        mesh.colors[vertex][part] = static_cast<std::uint8_t>(color[part] + 0.5f);
      mesh.internodes[vertex] = joints[i].older;
    }
    for (const auto& [a, b, c] : patches[i].triangles)
      mesh.triangles[triangle++] = {base + a, base + b, base + c};
  }
}

}  // namespace

void append_fork_bark(Mesh& mesh, const Skeleton& skeleton, std::span<const float> repeats,
                      const MesherOptions& options) {
  const auto is_bark = [&](const MaterialRange& range) { return mesh.material(range).name == "bark"; };
  const auto bark = std::find_if(mesh.ranges.begin(), mesh.ranges.end(), is_bark);
  if (bark == mesh.ranges.end() || mesh.material(*bark).image.is_empty()) return;

  const std::vector<Joint> joints = find_joints(skeleton);
  const TrianglesOfNodes triangles(mesh, *bark, skeleton.node_count(), joints);
  const Tree tree{mesh, skeleton, options, BarkStretches(skeleton), std::ranges::max(skeleton.diameter)};
  std::vector<Patch> patches(joints.size());
  parallel_for(joints.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Joint& joint = joints[i];
      const std::vector<std::uint32_t> bearer = triangles.of(joint.older_nodes);
      if (bearer.empty()) continue;
      patches[i] =
          PatchMaker(tree, joint, repeats[joint.older], bearer).make(triangles.of(joint.lateral_nodes));
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
