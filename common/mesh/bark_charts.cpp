#include "common/mesh/bark_charts.h"

#include <algorithm>
#include <compare>

#include "common/base/parallel.h"
#include "common/mesh/bark_stretches.h"
#include "common/mesh/chart_borders.h"

namespace ramify {
namespace {

constexpr std::size_t kGrain = 1 << 14;  // triangles

class Charts {
 public:
  Charts(const Skeleton& skeleton, const Mesh& mesh)
      : skeleton_(skeleton), mesh_(mesh), stretches_(skeleton) {}

  /// u from -1/2 to 1/2.
  Vec2f uv(std::uint32_t internode, std::uint32_t vertex) const {
    return stretches_.uv(internode, Vec3(mesh_.positions[vertex]));
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
  const Skeleton& skeleton_;
  const Mesh& mesh_;
  BarkStretches stretches_;
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
