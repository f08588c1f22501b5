#include "tests/common/manifolds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

namespace ramify::test {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::array<Vec3, 3> corners(const Mesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return {Vec3(mesh.positions[a]), Vec3(mesh.positions[b]), Vec3(mesh.positions[c])};
}

Vec3 area_vector(const std::array<Vec3, 3>& t) {
  return 0.5 * glm::cross(t[1] - t[0], t[2] - t[0]);
}

std::vector<Edge> directed_edges(const Mesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (const auto& [a, b, c] : mesh.triangles) {
    edges.emplace_back(a, b);
    edges.emplace_back(b, c);
    edges.emplace_back(c, a);
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

void check_edges(const Mesh& mesh, std::vector<std::string>& found) {
  const std::vector<Edge> edges = directed_edges(mesh);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [a, b] = edges[i];
    if (i > 0 && edges[i - 1] == edges[i]) {
      found.push_back(fmt::format("edge {} to {}: more than one triangle", a, b));
    }
    if (!std::binary_search(edges.begin(), edges.end(), Edge(b, a))) {
      found.push_back(fmt::format("edge {} to {}: no triangle on the other side", a, b));
    }
  }
}

/// The triangles around each vertex, joined where they share an edge at it, are one fan.
void check_fans(const Mesh& mesh, std::vector<std::string>& found) {
  std::vector<std::vector<Edge>> links(mesh.vertex_count());  // the edge opposite, of each triangle
  for (const auto& [a, b, c] : mesh.triangles) {
    links[a].emplace_back(b, c);
    links[b].emplace_back(c, a);
    links[c].emplace_back(a, b);
  }
  for (std::size_t v = 0; v < links.size(); ++v) {
    std::map<std::uint32_t, std::uint32_t> next(links[v].begin(), links[v].end());
    std::size_t length = 0;
    if (!next.empty()) {
      const std::uint32_t first = next.begin()->first;
      std::uint32_t at = first;
      do {
        const auto step = next.find(at);
        if (step == next.end()) break;
        at = step->second;
        ++length;
      } while (at != first && length <= links[v].size());
    }
    if (length == 0 || length != links[v].size()) {
      found.push_back(
          fmt::format("vertex {}: {} triangles, {} in its first fan", v, links[v].size(), length));
    }
  }
}

void check_places(const Mesh& mesh, std::vector<std::string>& found) {
  std::vector<std::array<float, 3>> places;
  for (const Vec3f& p : mesh.positions) places.push_back({p.x, p.y, p.z});
  std::sort(places.begin(), places.end());
  if (std::adjacent_find(places.begin(), places.end()) != places.end()) {
    found.push_back("two vertices in one place");
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double area = glm::length(area_vector(corners(mesh, t)));
    if (!(area > 0.0)) found.push_back(fmt::format("triangle {}: area {}", t, area));
  }
}

void check_attributes(const Mesh& mesh, std::vector<std::string>& found) {
  std::vector<Vec3> outwards(mesh.vertex_count(), Vec3(0.0));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) outwards[v] += area_vector(corners(mesh, t));
  }
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3f& normal = mesh.normals[v];
    if (!(std::abs(glm::length(normal) - 1.0f) < 1e-4f)) {
      found.push_back(fmt::format("vertex {}: normal of length {}", v, glm::length(normal)));
    } else if (glm::dot(Vec3(normal), outwards[v]) < 0.0) {
      found.push_back(fmt::format("vertex {}: its normal points inwards", v));
    }
    if (!std::isfinite(mesh.uvs[v].x) || !std::isfinite(mesh.uvs[v].y)) {
      found.push_back(fmt::format("vertex {}: uv is no number", v));
    }
  }
}

/// Whether the segment passes through the triangle's inside.
bool pierces(const Vec3& from, const Vec3& to, const std::array<Vec3, 3>& t) {
  const auto volume = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return glm::dot(glm::cross(b - a, c - a), d - a);
  };
  if ((volume(t[0], t[1], t[2], from) > 0.0) == (volume(t[0], t[1], t[2], to) > 0.0)) return false;
  const double a = volume(from, to, t[0], t[1]);
  const double b = volume(from, to, t[1], t[2]);
  const double c = volume(from, to, t[2], t[0]);
  return (a > 0.0 && b > 0.0 && c > 0.0) || (a < 0.0 && b < 0.0 && c < 0.0);
}

bool cut(const std::array<Vec3, 3>& s, const std::array<Vec3, 3>& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (pierces(s[i], s[(i + 1) % 3], t) || pierces(t[i], t[(i + 1) % 3], s)) return true;
  }
  return false;
}

Box box_of(const std::array<Vec3, 3>& t) {
  Box box;
  for (const Vec3& p : t) box.include(p);
  return box;
}

}  // namespace

std::vector<std::string> manifold_violations(const Mesh& mesh) {
  std::vector<std::string> found;
  check_edges(mesh, found);
  check_fans(mesh, found);
  check_places(mesh, found);
  check_attributes(mesh, found);
  return found;
}

Mesh welded(const Mesh& mesh) {
  std::map<std::array<float, 3>, std::uint32_t> known;
  std::vector<std::uint32_t> place;
  Mesh result;
  result.triangles = mesh.triangles;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3f& p = mesh.positions[v];
    const auto next = static_cast<std::uint32_t>(result.vertex_count());
    const auto [found, is_new] = known.try_emplace({p.x, p.y, p.z}, next);
    place.push_back(found->second);
    if (!is_new) continue;
    result.positions.push_back(p);
    result.normals.push_back(mesh.normals[v]);
    result.uvs.push_back(mesh.uvs[v]);
    result.internodes.push_back(mesh.internodes[v]);
  }
  for (auto& triangle : result.triangles) {
    for (std::uint32_t& vertex : triangle) vertex = place[vertex];
  }
  return result;
}

std::size_t self_intersections(const Mesh& mesh) {
  // Triangles sorted into the cells of a grid that they touch.
  double longest = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 size = box_of(corners(mesh, t)).size();
    longest += std::max({size.x, size.y, size.z}) / static_cast<double>(mesh.triangles.size());
  }
  const double cell = 2.0 * longest;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells;
  const auto key = [](int x, int y, int z) {
    const auto part = [](int i) { return static_cast<std::uint64_t>(i + (1 << 20)); };
    return part(x) << 42 | part(y) << 21 | part(z);
  };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Box box = box_of(corners(mesh, t));
    const Coord low(glm::floor(box.low / cell));
    const Coord high(glm::floor(box.high / cell));
    for (int x = low.x; x <= high.x; ++x) {
      for (int y = low.y; y <= high.y; ++y) {
        for (int z = low.z; z <= high.z; ++z) cells[key(x, y, z)].push_back(t);
      }
    }
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const auto& [place, members] : cells) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      const auto& first = mesh.triangles[members[i]];
      const std::array<Vec3, 3> s = corners(mesh, members[i]);
      const Box s_box = box_of(s);
      for (std::size_t j = 0; j < i; ++j) {
        const auto& second = mesh.triangles[members[j]];
        const std::array<Vec3, 3> t = corners(mesh, members[j]);
        const Box t_box = box_of(t);
        const bool is_apart =
            glm::any(glm::lessThan(s_box.high, t_box.low)) || glm::any(glm::lessThan(t_box.high, s_box.low));
        const bool is_joined =
            std::find_first_of(first.begin(), first.end(), second.begin(), second.end()) != first.end();
        if (!is_apart && !is_joined && cut(s, t)) pairs.emplace_back(members[j], members[i]);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return static_cast<std::size_t>(std::unique(pairs.begin(), pairs.end()) - pairs.begin());
}

std::size_t component_count(const Mesh& mesh) {
  std::vector<std::uint32_t> leader(mesh.vertex_count());
  std::iota(leader.begin(), leader.end(), 0u);
  const auto find = [&](std::uint32_t v) {
    while (leader[v] != v) v = leader[v] = leader[leader[v]];
    return v;
  };
  std::size_t count = leader.size();
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    leader[a] = b;
    --count;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    join(a, b);
    join(b, c);
  }
  return count;
}

long euler_characteristic(const Mesh& mesh) {
  std::vector<Edge> edges = directed_edges(mesh);
  for (auto& [a, b] : edges) {
    if (a > b) std::swap(a, b);
  }
  std::sort(edges.begin(), edges.end());
  const auto edge_count = std::unique(edges.begin(), edges.end()) - edges.begin();
  return static_cast<long>(mesh.vertex_count()) - edge_count + static_cast<long>(mesh.triangles.size());
}

double enclosed_volume(const Mesh& mesh) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::array<Vec3, 3> at = corners(mesh, t);
    sum += glm::dot(at[0], area_vector(at)) / 3.0;
  }
  return sum;
}

}  // namespace ramify::test
