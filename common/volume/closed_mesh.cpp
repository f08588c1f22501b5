#include "common/volume/closed_mesh.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "common/base/errors.h"
#include "common/base/files.h"

namespace ramify {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;  // the lower corner first

/// On one line what the reader may say on several.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

ClosedMesh read_triangles(const std::string& text, const std::string& name) {
  tinyobj::ObjReaderConfig config;
  config.vertex_color = false;
  tinyobj::ObjReader reader;
  if (!reader.ParseFromString(text, "", config)) {
    throw InputError(fmt::format("{}: no OBJ: {}", name, one_line(reader.Error())));
  }

  ClosedMesh mesh;
  const std::vector<tinyobj::real_t>& numbers = reader.GetAttrib().vertices;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
    mesh.points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  }
  for (const tinyobj::shape_t& shape : reader.GetShapes()) {
    const std::vector<tinyobj::index_t>& corners = shape.mesh.indices;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      std::array<std::uint32_t, 3> triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        const int corner = corners[i + k].vertex_index;
        if (corner < 0 || static_cast<std::size_t>(corner) >= mesh.points.size()) {
          throw InputError(
              fmt::format("{}: a face has corner {} of {} points", name, corner + 1, mesh.points.size()));
        }
        triangle[k] = static_cast<std::uint32_t>(corner);
      }
      mesh.triangles.push_back(triangle);
    }
  }
  return mesh;
}

/// Files give a corner once for each face it has where the faces differ in something else.
void join_corners(ClosedMesh& mesh) {
  const auto key = [&](std::uint32_t i) {
    return std::array{mesh.points[i].x, mesh.points[i].y, mesh.points[i].z};
  };
  std::vector<std::uint32_t> order(mesh.points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  std::vector<std::uint32_t> joined(mesh.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && key(order[i]) == key(order[i - 1]);
    joined[order[i]] = is_same ? joined[order[i - 1]] : order[i];
  }
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) corner = joined[corner];
  }
  std::erase_if(mesh.triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
}

std::string place(const Vec3f& point) {
  return fmt::format("({}, {}, {})", point.x, point.y, point.z);
}

void check_closed(const ClosedMesh& mesh, const std::string& name) {
  std::map<Edge, int> triangles_at;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      ++triangles_at[std::minmax(triangle[k], triangle[(k + 1) % 3])];
    }
  }
  std::size_t open_count = 0;
  Edge first_open;
  for (const auto& [edge, count] : triangles_at) {
    if (count % 2 == 0) continue;
    if (open_count++ == 0) first_open = edge;
  }
  if (open_count == 0) return;
  throw InputError(fmt::format("{}: not closed: {} of {} edges lack a triangle, one is from {} to {}", name,
                               open_count, triangles_at.size(), place(mesh.points[first_open.first]),
                               place(mesh.points[first_open.second])));
}

}  // namespace

ClosedMesh read_closed_mesh(const std::filesystem::path& file) {
  const std::string name = file.string();
  ClosedMesh mesh = read_triangles(read_file(file), name);
  const bool is_finite = std::all_of(mesh.points.begin(), mesh.points.end(), [](const Vec3f& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  });
  if (!is_finite) throw InputError(fmt::format("{}: a point is not finite", name));
  join_corners(mesh);
  if (mesh.triangles.empty()) throw InputError(fmt::format("{}: no faces (a closed mesh)", name));
  check_closed(mesh, name);
  return mesh;
}

}  // namespace ramify
