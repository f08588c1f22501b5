#include "viewer/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/base/errors.h"
#include "common/mesh/attribute_colors.h"
#include "common/mesh/mesh.h"
#include "common/mesh/palette.h"
#include "common/skeleton/skeleton.h"

namespace ramify {
namespace {

constexpr ColorBytes kBlack{0, 0, 0, 255};
constexpr ColorBytes kLeafGreen{86, 118, 52, 255};

// Obstacles are shown this far around a tree, in parts of its size: a long wall does not make it small.
constexpr double kObstacleRoom = 0.25;

// As many points are no trouble; of more, those on the outside are picked out by cells so many a side.
constexpr std::size_t kManyPoints = 100'000;
constexpr int kOutlineCells = 96;

/// Of the points in each row of cells along one axis, the first and the last.
class RowEnds {
 public:
  RowEnds(int axis, const Box& box)
      : axis_(axis), low_(box.low), cell_(glm::max(box.size(), 1e-9) / double{kOutlineCells}) {}

  void include(const Vec3f& point) {
    const glm::ivec3 at = glm::clamp(glm::ivec3((Vec3(point) - low_) / cell_), 0, kOutlineCells - 1);
    Ends& row = rows_[static_cast<std::size_t>(at[(axis_ + 1) % 3] * kOutlineCells + at[(axis_ + 2) % 3])];
    if (row.first == nullptr || point[axis_] < (*row.first)[axis_]) row.first = &point;
    if (row.last == nullptr || point[axis_] > (*row.last)[axis_]) row.last = &point;
  }

  void append_to(std::vector<Vec3f>& points) const {
    for (const Ends& row : rows_) {
      if (row.first == nullptr) continue;
      points.push_back(*row.first);
      points.push_back(*row.last);
    }
  }

 private:
  struct Ends {
    const Vec3f* first = nullptr;
    const Vec3f* last = nullptr;
  };

  int axis_;
  Vec3 low_;
  Vec3 cell_;
  std::vector<Ends> rows_ = std::vector<Ends>(static_cast<std::size_t>(kOutlineCells) * kOutlineCells);
};

std::vector<ColorBytes> bytes_of(const std::vector<Color>& colors) {
  std::vector<ColorBytes> bytes(colors.size());
  std::transform(colors.begin(), colors.end(), bytes.begin(), color_bytes);
  return bytes;
}

/// What each vertex gets from the node it belongs to.
std::vector<ColorBytes> gathered(const std::vector<ColorBytes>& of_node, const Mesh& mesh) {
  assert(mesh.internodes.size() == mesh.vertex_count());
  std::vector<ColorBytes> colors(mesh.vertex_count());
  for (std::size_t vertex = 0; vertex < colors.size(); ++vertex) {
    assert(mesh.internodes[vertex] < of_node.size());
    colors[vertex] = of_node[mesh.internodes[vertex]];
  }
  return colors;
}

std::vector<ColorBytes> bark_colors(const Scene& scene) {
  if (scene.skeleton == nullptr) {
    constexpr double kMiddlingDiameter = 0.05;
    return std::vector<ColorBytes>(scene.mesh->vertex_count(), color_bytes(bark_color(kMiddlingDiameter)));
  }
  std::vector<ColorBytes> of_node(scene.skeleton->node_count());
  for (std::size_t node = 0; node < of_node.size(); ++node) {
    of_node[node] = color_bytes(bark_color(scene.skeleton->diameter[node]));
  }
  return gathered(of_node, *scene.mesh);
}

void color_leaves(const Mesh& mesh, std::vector<ColorBytes>& colors) {
  for (const MaterialRange& range : mesh.ranges) {
    if (mesh.material(range).name != "leaf") continue;
    for (std::size_t index = 0; index < range.triangle_count; ++index) {
      for (std::uint32_t vertex : mesh.triangles[range.first_triangle + index]) colors[vertex] = kLeafGreen;
    }
  }
}

void require_skeleton(const Scene& scene, const std::string& color_by) {
  if (scene.skeleton != nullptr) return;
  throw InputError(fmt::format(
      "--color-by: there is no attribute '{}': the input is a mesh without a skeleton", color_by));
}

}  // namespace

std::vector<Vec3f> outline_of(std::span<const Vec3f> points) {
  if (points.size() <= kManyPoints) return {points.begin(), points.end()};
  Box box;
  for (const Vec3f& point : points) box.include(Vec3(point));
  std::vector<Vec3f> outline;
  for (int axis = 0; axis < 3; ++axis) {
    RowEnds rows(axis, box);
    for (const Vec3f& point : points) rows.include(point);
    rows.append_to(outline);
  }
  return outline;
}

std::span<const Vec3f> outline_of(const Scene& scene) {
  if (!scene.outline.empty()) return scene.outline;
  if (scene.mesh == nullptr) return {};
  return scene.mesh->positions;
}

Vec3 base_of(const Scene& scene) {
  if (scene.skeleton != nullptr && scene.skeleton->node_count() > 0) {
    const Skeleton& skeleton = *scene.skeleton;
    Vec3 lowest = skeleton.position[0];
    for (std::size_t root = 1; root < skeleton.root_count(); ++root) {
      if (skeleton.position[root].y < lowest.y) lowest = skeleton.position[root];
    }
    return lowest;
  }
  Box box;
  for (const Vec3f& position : outline_of(scene)) box.include(Vec3(position));
  return box.is_empty() ? Vec3(0.0) : Vec3(box.center().x, box.low.y, box.center().z);
}

Box obstacle_room(const Mesh& obstacles, const Box& tree) {
  Box box;
  for (const Vec3f& position : obstacles.positions) box.include(Vec3(position));
  return obstacle_room(box, tree);
}

Box obstacle_room(const Box& obstacles, const Box& tree) {
  if (tree.is_empty() || obstacles.is_empty()) return {};
  const Vec3 size = tree.size();
  const double around = kObstacleRoom * std::max({size.x, size.y, size.z});
  Box room{glm::max(obstacles.low, tree.low - around), glm::min(obstacles.high, tree.high + around)};
  return room.is_empty() ? Box() : room;
}

bool shows_materials(const Mesh& mesh) {
  return !mesh.colors.empty() || std::any_of(mesh.materials.begin(), mesh.materials.end(),
                                             [](const Material& m) { return !m.image.is_empty(); });
}

std::vector<ColorBytes> vertex_colors(const Scene& scene, const RenderOptions& options) {
  if (options.tint) {
    const std::size_t count = scene.mesh == nullptr ? 0 : scene.mesh->vertex_count();
    return std::vector<ColorBytes>(count, color_bytes(*options.tint));
  }
  if (!options.color_by.empty()) {
    require_skeleton(scene, options.color_by);
    const std::vector<Color> of_node = attribute_colors(*scene.skeleton, options.color_by);
    return scene.mesh == nullptr ? std::vector<ColorBytes>() : gathered(bytes_of(of_node), *scene.mesh);
  }
  if (scene.mesh == nullptr) return {};
  if (options.style == RenderStyle::schematic)
    return std::vector<ColorBytes>(scene.mesh->vertex_count(), kBlack);
  if (const auto& own = scene.mesh->colors; !own.empty()) return {own.begin(), own.end()};
  if (shows_materials(*scene.mesh)) {
    return std::vector<ColorBytes>(scene.mesh->vertex_count(), {255, 255, 255, 255});
  }
  std::vector<ColorBytes> colors = bark_colors(scene);
  color_leaves(*scene.mesh, colors);
  return colors;
}

std::vector<ColorBytes> node_colors(const Scene& scene, const RenderOptions& options) {
  if (scene.skeleton == nullptr) {
    throw InputError(
        "--style: skeleton: the input is a mesh without a skeleton (lit and schematic can draw it)");
  }
  if (options.tint) return std::vector<ColorBytes>(scene.skeleton->node_count(), color_bytes(*options.tint));
  return bytes_of(attribute_colors(*scene.skeleton, options.color_by.empty() ? "order" : options.color_by));
}

}  // namespace ramify
