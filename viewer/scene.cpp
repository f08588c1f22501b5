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
  if (scene.mesh != nullptr) {
    for (const Vec3f& position : scene.mesh->positions) box.include(Vec3(position));
  }
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
