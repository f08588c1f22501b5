#include "common/mesh/bark_charts.h"

#include <algorithm>
#include <cmath>
#include <compare>

#include "common/base/parallel.h"
#include "common/mesh/axes.h"
#include "common/mesh/chart_borders.h"

namespace ramify {
namespace {

constexpr std::size_t kGrain = 1 << 14;  // triangles

// Stretches of an axis are at least so long, in radii: the planes between shorter ones would meet within
// thick wood that bends.
constexpr float kLeastStretch = 2.0f;

// A point is so many stretches from the one of its internode at the most.
constexpr int kStretchesAway = 8;

/// How the texture lies on a straight part of an axis.
struct Stretch {
  Vec3 base;
  Vec3 tip;
  Vec3 along = kUp;
  Vec3 side{1, 0, 0};     // perpendicular to it; u is 0 there
  Vec3 base_plane = kUp;  // normals of the planes in which it meets its neighbours of the axis
  Vec3 tip_plane = kUp;
  double start = 0.0;  // v at the base and at the tip
  double end = 0.0;
  bool is_first = true;  // of its axis
  bool is_last = true;
};

/// The stretches of all axes, one after the other, and the one that each internode lies on.
struct Stretches {
  std::vector<Stretch> list;
  std::vector<std::uint32_t> of_internode;

  explicit Stretches(const Skeleton& skeleton) : of_internode(skeleton.node_count(), 0) {
    const Axes axes = find_axes(skeleton);
    for (const Axis& axis : axes.list) add(axes, axis);
  }

 private:
  void add(const Axes& axes, const Axis& axis) {
    const std::size_t first = list.size();
    std::uint32_t base = axis.first;
    for (std::uint32_t point = axis.first + 1; point < axis.end(); ++point) {
      const AxisPoint& from = axes.points[base];
      const AxisPoint& to = axes.points[point];
      of_internode[to.node] = static_cast<std::uint32_t>(list.size());
      const float length = glm::distance(from.position, to.position);
      const bool is_tip = point + 1 == axis.end();
      if (length < kLeastStretch * std::max(from.radius, to.radius) && !is_tip) continue;
      add(from, to, list.size() > first);
      base = point;
    }
  }

  /// Frames are carried along each axis, so that neither u nor v jumps from one stretch to the next.
  void add(const AxisPoint& from, const AxisPoint& to, bool goes_on) {
    Stretch stretch{.base = Vec3(from.position), .tip = Vec3(to.position)};
    stretch.along = normalized_or(stretch.tip - stretch.base, goes_on ? list.back().along : kUp, 1e-12);
    stretch.base_plane = stretch.tip_plane = stretch.along;
    stretch.side = any_perpendicular(stretch.along);
    if (goes_on) {
      Stretch& below = list.back();
      stretch.side = transported(below.side, below.along, stretch.along);
      stretch.start = below.end;
      stretch.base_plane = below.tip_plane = normalized_or(below.along + stretch.along, stretch.along);
      stretch.is_first = below.is_last = false;
    }
    const double girth = std::numbers::pi * (double{from.radius} + double{to.radius});
    stretch.end = stretch.start + glm::length(stretch.tip - stretch.base) / girth;
    list.push_back(stretch);
  }
};

class Charts {
 public:
  Charts(const Skeleton& skeleton, const Mesh& mesh)
      : skeleton_(skeleton), mesh_(mesh), stretches_(skeleton) {}

  /// u from -1/2 to 1/2.
  Vec2f uv(std::uint32_t internode, std::uint32_t vertex) const {
    const Vec3 at(mesh_.positions[vertex]);
    const Stretch& stretch = stretch_at(at, stretches_.of_internode[internode]);
    const Vec3 from_base = at - stretch.base;
    const double angle = std::atan2(glm::dot(from_base, glm::cross(stretch.along, stretch.side)),
                                    glm::dot(from_base, stretch.side));
    double before = glm::dot(from_base, stretch.base_plane);
    double after = glm::dot(stretch.tip - at, stretch.tip_plane);
    // On the inner side of a sharp bend the planes meet: there the place along the line decides.
    if ((before < 0.0 && !stretch.is_first) || (after < 0.0 && !stretch.is_last)) {
      before = glm::dot(from_base, stretch.along);
      after = glm::dot(stretch.tip - at, stretch.along);
    }
    const double whole = before + after;
    const double share = whole > 1e-12 ? before / whole : 0.5;
    return {static_cast<float>(angle / (2.0 * std::numbers::pi)),
            static_cast<float>(stretch.start + share * (stretch.end - stretch.start))};
  }

  /// The internode in whose chart each corner lies: its own, or the triangle's.
  Triangle internodes_of(const Triangle& triangle, std::uint32_t internode) const {
    Triangle result{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t own = mesh_.internodes[triangle[i]];
      result[i] = skeleton_.axis[own] == skeleton_.axis[internode] ? own : internode;
    }
    return result;
  }

 private:
  /// The stretch between whose planes a point lies, looked for from one that is near on its axis.
  const Stretch& stretch_at(const Vec3& at, std::size_t index) const {
    int direction = 0;
    for (int step = 0; step < kStretchesAway; ++step) {
      const Stretch& stretch = stretches_.list[index];
      const bool is_before = !stretch.is_first && glm::dot(at - stretch.base, stretch.base_plane) < 0.0;
      const bool is_after = !stretch.is_last && glm::dot(stretch.tip - at, stretch.tip_plane) < 0.0;
      if (is_before == is_after || direction == (is_before ? 1 : -1)) break;
      direction = is_before ? -1 : 1;
      index = is_before ? index - 1 : index + 1;
    }
    return stretches_.list[index];
  }

  const Skeleton& skeleton_;
  const Mesh& mesh_;
  Stretches stretches_;
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

void find_uses(const Charts& charts, const Mesh& mesh, std::uint32_t t, std::uint32_t internode,
               std::vector<Use>& uses) {
  const auto& triangle = mesh.triangles[t];
  const auto internodes = charts.internodes_of(triangle, internode);
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
std::vector<Use> all_uses(const Charts& charts, const Mesh& mesh,
                          const std::vector<std::uint32_t>& internodes) {
  std::vector<std::vector<Use>> blocks((mesh.triangles.size() + kGrain - 1) / kGrain);
  parallel_for(blocks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const std::size_t last = std::min(mesh.triangles.size(), (block + 1) * kGrain);
      for (std::size_t t = block * kGrain; t < last; ++t) {
        find_uses(charts, mesh, static_cast<std::uint32_t>(t), internodes[t], blocks[block]);
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
  const std::vector<std::uint32_t> internodes = cut_between_axes(skeleton, mesh);
  const Charts charts(skeleton, mesh);
  mesh.uvs.resize(mesh.vertex_count());
  parallel_for(mesh.vertex_count(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      mesh.uvs[v] = charts.uv(mesh.internodes[v], static_cast<std::uint32_t>(v));
    }
  });
  const std::vector<Use> uses = all_uses(charts, mesh, internodes);
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
