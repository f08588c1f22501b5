#include "common/mesh/fork_bark.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/parallel.h"
#include "common/mesh/bark_stretches.h"
#include "common/mesh/joints.h"
#include "common/mesh/nearest_triangle.h"
#include "common/mesh/refinement.h"

namespace ramify {
namespace {

// In radii of the lateral: so far from its bearer's surface the bearer's bark has faded out.
constexpr float kFade = 0.6f;

// Between vertices that are farther apart than so many fades the opacity changes by no more than this.
constexpr float kLongest = 2.0f;
constexpr float kOpacityStep = 0.5f;

// Times that the overlay is refined at the most: triangles without area could be for ever.
constexpr int kRefinements = 10;

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

class PatchMaker {
 public:
  PatchMaker(const Mesh& mesh, const Skeleton& skeleton, const BarkStretches& stretches, const Joint& joint,
             float repeats, bool is_closed, const std::vector<std::uint32_t>& bearer)
      : mesh_(mesh),
        skeleton_(skeleton),
        stretches_(stretches),
        joint_(joint),
        repeats_(repeats),
        is_closed_(is_closed),
        fade_(kFade * joint.radius),
        bearer_(mesh, bearer) {}

  Patch make(const std::vector<std::uint32_t>& lateral) {
    cover(lateral);
    refine_triangles();
    for (const Triangle& triangle : triangles_) {
      if (is_seen(triangle)) add(triangle);
    }
    return std::move(patch_);
  }

 private:
  /// The triangles of the lateral on which the bearer's bark may be seen.
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
      if (is_seen(triangle)) triangles_.push_back(triangle);
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
    const float missing = std::max(cover.distance - glm::length(girths) * girth, 0.0f);
    // Behind the border of a part of a closed surface one is not inside.
    if (!is_closed_ && glm::dot(point - nearest.point, normal) < kInside * cover.distance)
      cover.distance *= -1.0f;
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

  float length(const Edge& edge) const {
    return glm::distance(vertices_[edge.first].position, vertices_[edge.second].position);
  }

  /// Whether opacity, which changes evenly along an edge, does so by much over a long way, or the bark's
  /// place does where the edge comes out of the bearer.
  bool is_coarse(const Edge& edge) const {
    const Cover& a = covers_[edge.first];
    const Cover& b = covers_[edge.second];
    if (length(edge) <= kLongest * fade_) return false;
    return (a.distance < 0.0f) != (b.distance < 0.0f) || std::abs(a.opacity - b.opacity) > kOpacityStep;
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
  const bool is_closed_;
  const float fade_;
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

void append_fork_bark(Mesh& mesh, const Skeleton& skeleton, std::span<const float> repeats, bool is_closed) {
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
      const std::vector<std::uint32_t> bearer = triangles.of(joint.older_nodes);
      if (bearer.empty()) continue;
      patches[i] = PatchMaker(mesh, skeleton, stretches, joint, repeats[joint.older], is_closed, bearer)
                       .make(triangles.of(joint.lateral_nodes));
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
