#include "common/mesh/bark_charts.h"

#include <algorithm>
#include <cmath>
#include <compare>

#include "common/base/parallel.h"

namespace ramify {
namespace {

constexpr std::size_t kGrain = 1 << 14;  // triangles

/// How an internode's texture lies.
struct Frame {
  Vec3 along = kUp;
  Vec3 side{1, 0, 0};     // perpendicular to it; u is 0 there
  Vec3 base_plane = kUp;  // normals of the planes in which it meets its neighbours of the axis
  Vec3 tip_plane = kUp;
  double start = 0.0;  // v at the base and at the tip
  double end = 0.0;
};

/// Frames are carried along each axis, so that neither u nor v jumps from one internode to the next.
std::vector<Frame> frames_of(const Skeleton& skeleton) {
  std::vector<Frame> frames(skeleton.node_count());
  for (std::size_t node = 0; node < frames.size(); ++node) {
    if (skeleton.is_root(node)) continue;
    Frame& frame = frames[node];
    const std::size_t parent = skeleton.parent[node];
    Frame& below = frames[parent];
    frame.along = normalized_or(skeleton.along(node), below.along, 1e-12);
    frame.tip_plane = frame.base_plane = frame.along;
    if (!skeleton.is_root(parent) && skeleton.axis[parent] == skeleton.axis[node]) {
      frame.side = transported(below.side, below.along, frame.along);
      frame.start = below.end;
      frame.base_plane = below.tip_plane = normalized_or(below.along + frame.along, frame.along);
    } else {
      frame.side = any_perpendicular(frame.along);
    }
    const double girth = std::numbers::pi * (skeleton.start_radius(node) + 0.5 * skeleton.diameter[node]);
    frame.end = frame.start + skeleton.length(node) / std::max(girth, 1e-9);
  }
  return frames;
}

class Charts {
 public:
  Charts(const Skeleton& skeleton, const Mesh& mesh)
      : skeleton_(skeleton), mesh_(mesh), frames_(frames_of(skeleton)) {}

  /// u from -1/2 to 1/2.
  Vec2f uv(std::uint32_t internode, std::uint32_t vertex) const {
    const Frame& frame = frames_[internode];
    const Vec3 at(mesh_.positions[vertex]);
    const Vec3 from_base = at - skeleton_.position[skeleton_.parent[internode]];
    const Vec3 to_tip = skeleton_.position[internode] - at;
    const double angle =
        std::atan2(glm::dot(from_base, glm::cross(frame.along, frame.side)), glm::dot(from_base, frame.side));
    double before = glm::dot(from_base, frame.base_plane);
    double after = glm::dot(to_tip, frame.tip_plane);
    // On the inner side of a sharp bend the planes meet: there the place along the line decides.
    if (before < 0.0 || after < 0.0) {
      before = glm::dot(from_base, frame.along);
      after = glm::dot(to_tip, frame.along);
    }
    const double whole = before + after;
    const double share = whole > 1e-12 ? before / whole : 0.5;
    return {static_cast<float>(angle / (2.0 * std::numbers::pi)),
            static_cast<float>(frame.start + share * (frame.end - frame.start))};
  }

  /// The internode in whose chart each corner lies: its own, or one of the axis that most corners have.
  Triangle internodes_of(const Triangle& triangle) const {
    Triangle own{};
    for (std::size_t i = 0; i < 3; ++i) own[i] = mesh_.internodes[triangle[i]];
    const auto axis = [&](std::size_t i) { return skeleton_.axis[own[i]]; };
    const std::size_t chosen = axis(1) == axis(2) ? 1 : 0;
    Triangle result = own;
    for (std::size_t i = 0; i < 3; ++i) {
      if (axis(i) != axis(chosen)) result[i] = own[chosen];
    }
    return result;
  }

 private:
  const Skeleton& skeleton_;
  const Mesh& mesh_;
  std::vector<Frame> frames_;
};

/// A vertex as a triangle's corner needs it: in the chart of another internode, or a turn further.
struct Double {
  std::uint32_t vertex;
  std::uint32_t internode;
  bool is_turned;
  friend auto operator<=>(const Double&, const Double&) = default;
};

struct Use {
  Double what;
  std::uint32_t triangle;
  std::uint32_t corner;
  friend auto operator<=>(const Use&, const Use&) = default;
};

void find_uses(const Charts& charts, const Mesh& mesh, std::uint32_t t, std::vector<Use>& uses) {
  const auto& triangle = mesh.triangles[t];
  const auto internodes = charts.internodes_of(triangle);
  std::array<float, 3> u{};
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_own = internodes[i] == mesh.internodes[triangle[i]];
    u[i] = is_own ? mesh.uvs[triangle[i]].x : charts.uv(internodes[i], triangle[i]).x;
  }
  const bool crosses = *std::max_element(u.begin(), u.end()) - *std::min_element(u.begin(), u.end()) > 0.5f;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const bool is_turned = crosses && u[i] < 0.0f;
    if (is_turned || internodes[i] != mesh.internodes[triangle[i]])
      uses.push_back({{triangle[i], internodes[i], is_turned}, t, i});
  }
}

/// In ascending order: all uses of one double together.
std::vector<Use> all_uses(const Charts& charts, const Mesh& mesh) {
  std::vector<std::vector<Use>> blocks((mesh.triangles.size() + kGrain - 1) / kGrain);
  parallel_for(blocks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const std::size_t last = std::min(mesh.triangles.size(), (block + 1) * kGrain);
      for (std::size_t t = block * kGrain; t < last; ++t) {
        find_uses(charts, mesh, static_cast<std::uint32_t>(t), blocks[block]);
      }
    }
  });
  std::vector<Use> uses;
  for (std::vector<Use>& block : blocks) {
    uses.insert(uses.end(), block.begin(), block.end());
    block = {};
  }
  std::sort(uses.begin(), uses.end());
  return uses;
}

}  // namespace

void lay_bark_charts(const Skeleton& skeleton, Mesh& mesh) {
  const Charts charts(skeleton, mesh);
  mesh.uvs.resize(mesh.vertex_count());
  parallel_for(mesh.vertex_count(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      mesh.uvs[v] = charts.uv(mesh.internodes[v], static_cast<std::uint32_t>(v));
    }
  });
  const std::vector<Use> uses = all_uses(charts, mesh);
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const Double& what = uses[i].what;
    if (i == 0 || what != uses[i - 1].what) {
      const Vec3f position = mesh.positions[what.vertex];
      const Vec3f normal = mesh.normals[what.vertex];
      Vec2f uv = charts.uv(what.internode, what.vertex);
      if (what.is_turned) uv.x += 1.0f;
      mesh.positions.push_back(position);
      mesh.normals.push_back(normal);
      mesh.uvs.push_back(uv);
      mesh.internodes.push_back(what.internode);
    }
    mesh.triangles[uses[i].triangle][uses[i].corner] = static_cast<std::uint32_t>(mesh.vertex_count() - 1);
  }
}

}  // namespace ramify
