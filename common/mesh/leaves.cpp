#include "common/mesh/leaves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/base/parallel.h"
#include "common/base/rng.h"
#include "common/mesh/mesh_files.h"

namespace ramify {
namespace {

// Of a tree: what no machine of today would draw, and far from where indices end.
constexpr std::size_t kMaxLeaves = 50'000'000;

/// By how much a level of detail has fewer leaves.
double fewer_at(int lod) {
  return std::exp2(lod);
}

double spacing_at(const LeafOptions& options, int lod) {
  return options.spacing * fewer_at(lod);
}

/// What leaves need to know of each node, carried along the axes from their bases.
struct Carried {
  std::vector<double> distance;  // along the axis, from where its first group of leaves would stand
  std::vector<Vec3> side;        // perpendicular to the internode, without twist
};

Carried carry_along_axes(const Skeleton& skeleton, double spacing, std::uint64_t seed) {
  Carried carried;
  carried.distance.resize(skeleton.node_count());
  carried.side.resize(skeleton.node_count(), Vec3(1, 0, 0));
  for (std::size_t node = skeleton.root_count(); node < skeleton.node_count(); ++node) {
    const std::uint32_t parent = skeleton.parent[node];
    const Vec3 along = normalized_or(skeleton.along(node), kUp, 1e-12);
    const bool goes_on = !skeleton.is_root(parent) && skeleton.axis[parent] == skeleton.axis[node];
    if (goes_on) {
      const Vec3 before = normalized_or(skeleton.along(parent), kUp, 1e-12);
      carried.side[node] = transported(carried.side[parent], before, along);
      carried.distance[node] = carried.distance[parent] + skeleton.length(node);
    } else {
      Rng rng = Rng::stream(seed, Stream::leaf_axis, skeleton.axis[node]);
      carried.side[node] = perpendicular_at(along, rng.uniform(0.0, 2.0 * std::numbers::pi));
      carried.distance[node] = rng.uniform(0.0, spacing) + skeleton.length(node);
    }
  }
  return carried;
}

/// Whether each node's internode bears leaves.
std::vector<bool> bearing_wood(const Skeleton& skeleton, const LeafOptions& options) {
  std::uint32_t last_step = 0;
  for (const std::uint32_t step : skeleton.birth_step) last_step = std::max(last_step, step);
  std::vector<bool> bears(skeleton.node_count(), false);
  for (std::size_t node = skeleton.root_count(); node < skeleton.node_count(); ++node) {
    const bool is_young = options.max_age == 0 ||
                          last_step - skeleton.birth_step[node] < static_cast<std::uint32_t>(options.max_age);
    bears[node] = is_young && skeleton.diameter[node] <= options.max_width &&
                  skeleton.order[node] >= options.min_order && skeleton.kind[node] == Kind::stem;
  }
  return bears;
}

/// Nodes that no internode grows from.
std::vector<bool> tips(const Skeleton& skeleton) {
  std::vector<bool> is_tip(skeleton.node_count(), true);
  for (std::size_t node = skeleton.root_count(); node < skeleton.node_count(); ++node) {
    is_tip[skeleton.parent[node]] = false;
  }
  return is_tip;
}

/// Groups of leaves on an internode: their ranks on the axis, and whether one closes it.
struct Groups {
  std::int64_t first = 0;
  std::int64_t end = 0;
  bool has_last = false;  // at the tip
};

Groups groups_on(double from, double to, double spacing, bool is_tip) {
  return {static_cast<std::int64_t>(std::ceil(from / spacing)),
          static_cast<std::int64_t>(std::ceil(to / spacing)), is_tip};
}

std::array<std::uint8_t, 3> tint_of(const LeafOptions& options, Rng& rng) {
  // Lighter or darker, and apart from that more or less yellow.
  const double light = 1.0 + options.color_jitter * rng.uniform(-1.0, 1.0);
  const double yellow = 0.6 * options.color_jitter * rng.uniform(-1.0, 1.0);
  const Vec3 own = options.mesh.empty() ? options.color : Vec3(1.0 / (1.0 + options.color_jitter));
  const Vec3 color = own * light * Vec3(1.0 + yellow, 1.0 + 0.3 * yellow, 1.0 - yellow);
  std::array<std::uint8_t, 3> bytes{};
  for (int i = 0; i < 3; ++i) {
    bytes[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(color[i], 0.0, 1.0)));
  }
  return bytes;
}

/// Right, direction and upper side of a leaf that leaves the twig `along` towards `outwards`.
glm::dmat3 leaf_frame(const Vec3& along, const Vec3& outwards, double angle, const LeafOptions& options,
                      Rng& rng) {
  const Vec3 straight = along * std::cos(angle) + outwards * std::sin(angle);
  const Vec3 direction = normalized_or(straight - kUp * options.droop, straight);
  // Away from the twig's tip lies the lower side.
  const Vec3 towards_tip = along * std::sin(angle) - outwards * std::cos(angle);
  const Vec3 wanted = glm::mix(towards_tip, kUp, options.facing_up);
  const Vec3 flat = wanted - direction * glm::dot(wanted, direction);
  const Vec3 upper = normalized_or(flat, any_perpendicular(direction));
  const Vec3 rolled = rotated(upper, direction, 0.35 * rng.uniform(-1.0, 1.0));
  return glm::dmat3(glm::cross(direction, rolled), direction, rolled);
}

/// Writes the leaves of one internode to `slots`.
class InternodeLeaves {
 public:
  InternodeLeaves(const Skeleton& skeleton, const LeafOptions& options, const Carried& carried,
                  std::uint64_t seed, int lod)
      : skeleton_(skeleton),
        options_(options),
        carried_(carried),
        seed_(seed),
        spacing_(spacing_at(options, lod)),
        enlarged_(std::sqrt(fewer_at(lod))) {}

  void place(std::uint32_t node, const Groups& groups, Leaf* slots) const {
    const Vec3 along = normalized_or(skeleton_.along(node), kUp, 1e-12);
    for (std::int64_t rank = groups.first; rank < groups.end; ++rank) {
      const double from_end = carried_.distance[node] - static_cast<double>(rank) * spacing_;
      slots = place_group(node, rank, skeleton_.position[node] - along * from_end,
                          radians(options_.angle_deg), slots);
    }
    // At the tip they stand steeper, as in a bud that has opened.
    if (groups.has_last) {
      place_group(node, groups.end, skeleton_.position[node], 0.4 * radians(options_.angle_deg), slots);
    }
  }

 private:
  Leaf* place_group(std::uint32_t node, std::int64_t rank, const Vec3& at, double angle, Leaf* slots) const {
    const Vec3 along = normalized_or(skeleton_.along(node), kUp, 1e-12);
    for (int i = 0; i < options_.per_node; ++i) {
      const auto index = static_cast<std::uint64_t>(rank * options_.per_node + i);
      Rng rng = Rng::stream(seed_, Stream::leaf, skeleton_.axis[node], index);
      const double azimuth = radians(options_.divergence_deg) * static_cast<double>(rank) +
                             2.0 * std::numbers::pi * i / options_.per_node + 0.25 * rng.uniform(-1.0, 1.0);
      const Vec3 outwards = rotated(carried_.side[node], along, azimuth);
      const double length =
          enlarged_ * options_.length * (1.0 + options_.length_jitter * rng.uniform(-1.0, 1.0));
      const double own_angle = angle + 0.2 * rng.uniform(-1.0, 1.0);
      *slots++ = {at + outwards * (0.4 * skeleton_.diameter[node]),
                  leaf_frame(along, outwards, own_angle, options_, rng) * length, node,
                  tint_of(options_, rng)};
    }
    return slots;
  }

  const Skeleton& skeleton_;
  const LeafOptions& options_;
  const Carried& carried_;
  std::uint64_t seed_;
  double spacing_;
  double enlarged_;  // times as long as at lod 0
};

}  // namespace

const Table& LeafOptions::fields() {
  static const Table table = make_table<LeafOptions>({
      {"shape",
       &LeafOptions::shape,
       {.help = "built-in leaf; needles: a tuft",
        .choices = {"none", "ovate", "lanceolate", "lobed", "needles"}}},
      {"form",
       &LeafOptions::form,
       {.help = "geometry: the outline in triangles; card: a few, with a picture",
        .choices = {"geometry", "card"}}},
      {"mesh",
       &LeafOptions::mesh,
       {.help = ".glb, .gltf or .obj instead of the shape: grows along +Y, upper side +Z, scaled to length"}},
      {"max_width",
       &LeafOptions::max_width,
       {.min = 0, .max = 100, .unit = "m", .help = "wood up to this diameter bears leaves"}},
      {"max_age",
       &LeafOptions::max_age,
       {.min = 0, .max = 1e6, .unit = "steps", .help = "wood younger than this bears leaves; 0: of any age"}},
      {"min_order",
       &LeafOptions::min_order,
       {.min = 0, .max = 65535, .help = "axes from this order on bear leaves"}},
      {"spacing",
       &LeafOptions::spacing,
       {.min = 0.0001,
        .max = 100,
        .unit = "m",
        .help = "from one group of leaves to the next along the twig"}},
      {"per_node",
       &LeafOptions::per_node,
       {.min = 1, .max = 64, .help = "leaves of a group: 1 alternate, 2 opposite"}},
      {"divergence_deg",
       &LeafOptions::divergence_deg,
       {.min = -360, .max = 360, .unit = "degrees", .help = "around the twig from one group to the next"}},
      {"length",
       &LeafOptions::length,
       {.min = 0.0001, .max = 100, .unit = "m", .help = "of a leaf, stalk included"}},
      {"length_jitter",
       &LeafOptions::length_jitter,
       {.min = 0, .max = 0.9, .help = "greatest deviation, in parts of the length"}},
      {"angle_deg",
       &LeafOptions::angle_deg,
       {.min = 0, .max = 180, .unit = "degrees", .help = "between twig and leaf"}},
      {"droop",
       &LeafOptions::droop,
       {.min = 0, .max = 10, .help = "weight of straight down in a leaf's direction"}},
      {"facing_up",
       &LeafOptions::facing_up,
       {.min = 0, .max = 1, .help = "0: the upper side faces along the twig; 1: up"}},
      {"color",
       &LeafOptions::color,
       {.min = 0, .max = 1, .help = "red, green and blue, sRGB; of the built-in shapes"}},
      {"color_jitter",
       &LeafOptions::color_jitter,
       {.min = 0, .max = 1, .help = "greatest deviation of a leaf's lightness; its hue varies less"}},
  });
  return table;
}

std::vector<Leaf> place_leaves(const Skeleton& skeleton, const LeafOptions& options, std::uint64_t seed,
                               int lod) {
  if (options.max_age > 0 && skeleton.birth_step.empty()) {
    throw InputError("leaves.max_age: the tree has no steps (0: wood of any age)");
  }
  const double spacing = spacing_at(options, lod);
  const Carried carried = carry_along_axes(skeleton, spacing, seed);
  const std::vector<bool> bears = bearing_wood(skeleton, options);
  const std::vector<bool> is_tip = tips(skeleton);

  std::vector<Groups> groups(skeleton.node_count());
  std::vector<std::size_t> first(skeleton.node_count());
  std::size_t count = 0;
  for (std::size_t node = 0; node < skeleton.node_count(); ++node) {
    first[node] = count;
    if (!bears[node]) continue;
    const double to = carried.distance[node];
    groups[node] = groups_on(to - skeleton.length(node), to, spacing, is_tip[node]);
    const auto in_all = groups[node].end - groups[node].first + (is_tip[node] ? 1 : 0);
    count += static_cast<std::size_t>(in_all) * static_cast<std::size_t>(options.per_node);
    if (count > kMaxLeaves) {
      throw RunError(
          fmt::format("leaves: more than {} (make leaves.spacing or leaves.max_width other)", kMaxLeaves));
    }
  }

  std::vector<Leaf> leaves(count);
  const InternodeLeaves placer(skeleton, options, carried, seed, lod);
  parallel_for(skeleton.node_count(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t node = begin; node < end; ++node) {
      if (bears[node])
        placer.place(static_cast<std::uint32_t>(node), groups[node], leaves.data() + first[node]);
    }
  });
  return leaves;
}

LeafModel leaf_model(const LeafOptions& options) {
  if (options.mesh.empty()) return make_leaf(options.shape, options.form);
  LeafModel model;
  const std::string name = options.mesh.string();
  model.mesh = read_mesh(options.mesh);
  Mesh& mesh = model.mesh;
  Box box;
  for (const Vec3f& position : mesh.positions) box.include(Vec3(position));
  if (mesh.triangles.empty()) throw InputError(fmt::format("{}: has no triangles", name));
  if (!(box.high.y > 0.0)) {
    throw InputError(
        fmt::format("{}: reaches up to y = {} (a leaf grows from 0 along +Y)", name, box.high.y));
  }
  for (Vec3f& position : mesh.positions) position /= static_cast<float>(box.high.y);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 u(mesh.positions[b] - mesh.positions[a]);
    const Vec3 v(mesh.positions[c] - mesh.positions[a]);
    model.area += 0.5 * glm::length(glm::cross(u, v));
  }
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    mesh.materials[i].name = i == 0 ? "leaf" : fmt::format("leaf-{}", i + 1);
    mesh.materials[i].is_two_sided = true;
  }
  return model;
}

void check_leaves(const LeafOptions& options) {
  try {
    if (!options.mesh.empty()) leaf_model(options);
  } catch (const InputError& error) {
    throw ConfigError({}, "mesh", error.what());
  }
}

void append_leaves(Mesh& mesh, const LeafModel& model, const std::vector<Leaf>& leaves) {
  const Mesh& one = model.mesh;
  if (leaves.empty()) return;
  const std::size_t first_vertex = mesh.vertex_count();
  const std::size_t first_triangle = mesh.triangles.size();
  const std::size_t vertices = first_vertex + leaves.size() * one.vertex_count();
  if (vertices > std::numeric_limits<std::uint32_t>::max()) {
    throw RunError(fmt::format("leaves: {} with {} vertices each are too many for a mesh", leaves.size(),
                               one.vertex_count()));
  }
  if (mesh.colors.empty()) mesh.colors.resize(first_vertex, {255, 255, 255, 255});
  resize_with_spare(mesh.positions, vertices);
  resize_with_spare(mesh.normals, vertices);
  resize_with_spare(mesh.uvs, vertices);
  resize_with_spare(mesh.colors, vertices);
  resize_with_spare(mesh.internodes, vertices);
  resize_with_spare(mesh.triangles, first_triangle + leaves.size() * one.triangles.size());

  // A range of the model becomes one of the tree, leaf after leaf.
  std::size_t range_begin = first_triangle;
  for (const MaterialRange& range : one.ranges) {
    const std::size_t count = leaves.size() * range.triangle_count;
    mesh.ranges.push_back({mesh.materials.size() + range.material, range_begin, count});
    range_begin += count;
  }
  mesh.materials.insert(mesh.materials.end(), one.materials.begin(), one.materials.end());

  parallel_for(leaves.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Leaf& leaf = leaves[i];
      const std::size_t base = first_vertex + i * one.vertex_count();
      for (std::size_t v = 0; v < one.vertex_count(); ++v) {
        mesh.positions[base + v] = Vec3f(leaf.base + leaf.frame * Vec3(one.positions[v]));
        mesh.normals[base + v] = Vec3f(normalized_or(leaf.frame * Vec3(one.normals[v]), kUp, 1e-12));
        mesh.uvs[base + v] = one.uvs[v];
        mesh.internodes[base + v] = leaf.internode;
        mesh.colors[base + v] = {leaf.tint[0], leaf.tint[1], leaf.tint[2], 255};
      }
      std::size_t ranges_before = first_triangle;
      for (const MaterialRange& range : one.ranges) {
        for (std::size_t t = 0; t < range.triangle_count; ++t) {
          const auto [a, b, c] = one.triangles[range.first_triangle + t];
          const auto shift = static_cast<std::uint32_t>(base);
          mesh.triangles[ranges_before + i * range.triangle_count + t] = {a + shift, b + shift, c + shift};
        }
        ranges_before += leaves.size() * range.triangle_count;
      }
    }
  });
}

}  // namespace ramify
