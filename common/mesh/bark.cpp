#include "common/mesh/bark.h"

#include <algorithm>

#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/base/parallel.h"
#include "common/mesh/axes.h"
#include "common/mesh/bark_texture.h"
#include "common/mesh/palette.h"

namespace ramify {
namespace {

using ColorBytes = std::array<std::uint8_t, 4>;

Image read_image(const std::filesystem::path& path) {
  return decoded_image(read_file(path), path.string());
}

/// The bark's own colour where its stem has this diameter.
Color color_of_kind(BarkKind kind, double diameter) {
  switch (kind) {
    case BarkKind::smooth:
      return smooth_bark_color(diameter);
    case BarkKind::plated:
      return plated_bark_color(diameter);
    default:
      return bark_color(diameter);
  }
}

/// `color`, encoded, so that a texture of `mean_shade` over it comes out like it.
Vec3f tint(const Color& color, double mean_shade) {
  const auto part = [mean_shade](float encoded) {
    return encoded_of(std::min(linear_of(encoded) / static_cast<float>(mean_shade), 1.0f));
  };
  return {part(color.r), part(color.g), part(color.b)};
}

// In radii of a lateral: so far beyond its parent's surface it has its own colour.
constexpr float kOwnColor = 3.0f;

// What a metre along the parent counts beside one away from it.
constexpr float kAlongside = 0.4f;

/// How the bark's colour changes over the wood: evenly along an axis, and at a fork from the parent's to the
/// lateral's.
class BarkColors {
 public:
  BarkColors(const Skeleton& skeleton, BarkKind kind, double mean_shade) : nodes_(skeleton.node_count()) {
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
      Node& own = nodes_[node];
      own.color = tint(color_of_kind(kind, skeleton.diameter[node]), mean_shade);
      own.position = Vec3f(skeleton.position[node]);
      if (skeleton.is_root(node)) continue;
      const std::uint32_t parent = skeleton.parent[node];
      own.parent = parent;
      const bool goes_on = skeleton.is_root(parent) || skeleton.axis[parent] == skeleton.axis[node];
      own.fork = goes_on ? nodes_[parent].fork : parent;
      own.fork_along =
          goes_on ? nodes_[parent].fork_along
                  : Vec3f(normalized_or(
                        Vec3(nodes_[parent].position - nodes_[nodes_[parent].parent].position), kUp));
      own.fork_radius =
          goes_on ? nodes_[parent].fork_radius : static_cast<float>(0.5 * skeleton.diameter[parent]);
      own.fork_end = goes_on ? nodes_[parent].fork_end
                             : static_cast<float>(0.5 * skeleton.diameter[parent]) +
                                   kOwnColor * static_cast<float>(0.5 * skeleton.diameter[node]);
    }
  }

  ColorBytes at(std::uint32_t internode, const Vec3f& point) const {
    const Node& own = nodes_[internode];
    if (own.parent == kNoParent) return bytes_of(own.color);
    const Node& below = nodes_[own.parent];
    Vec3f color = own.color;
    if (own.parent != own.fork) {
      const Vec3f along = own.position - below.position;
      const float length2 = std::max(glm::dot(along, along), 1e-12f);
      color = glm::mix(below.color, own.color,
                       std::clamp(glm::dot(point - below.position, along) / length2, 0.0f, 1.0f));
    }
    if (own.fork != kNoParent) {
      const Node& fork = nodes_[own.fork];
      const Vec3f apart = point - fork.position;
      const float aside = glm::length(apart - own.fork_along * glm::dot(apart, own.fork_along));
      // A lateral that runs alongside its parent gets its own colour, too, if later.
      const float distance = std::max(aside, kAlongside * glm::length(apart));
      color = glm::mix(fork.color, color, glm::smoothstep(own.fork_radius, own.fork_end, distance));
    }
    return bytes_of(color);
  }

 private:
  struct Node {
    Vec3f color{0.0f};  // encoded, 0 to 1
    Vec3f position{0.0f};
    std::uint32_t parent = kNoParent;
    std::uint32_t fork = kNoParent;  // the node at which the axis leaves another
    Vec3f fork_along{0.0f};          // unit, of the wood there
    float fork_radius = 0.0f;        // metres
    float fork_end = 0.0f;           // so far from the wood's middle the axis has its own colour, metres
  };

  static ColorBytes bytes_of(const Vec3f& color) {
    const auto byte = [](float part) { return static_cast<std::uint8_t>(255.0f * part + 0.5f); };
    return {byte(color.r), byte(color.g), byte(color.b), 255};
  }

  std::vector<Node> nodes_;
};

// Young trees have a finer bark, so that it does not coarsen from one axis to the next.
constexpr double kLeastAroundTrunk = 3.0;

void set_texture(Material& material, const BarkOptions& options, double& mean_shade) {
  material.color = Vec3f(1.0f);
  if (!options.image.empty()) {
    material.image = read_image(options.image);
    if (!options.normal.empty()) material.normal_map = read_image(options.normal);
  } else if (options.kind != BarkKind::plain) {
    BarkTexture texture = make_bark_texture(options.kind, options.resolution);
    material.image = std::move(texture.shade);
    material.normal_map = std::move(texture.normal_map);
    mean_shade = texture.mean_shade;
  }
}

void check_image(const std::filesystem::path& path, const std::string& key) {
  if (path.empty()) return;
  try {
    read_image(path);
  } catch (const InputError& error) {
    throw ConfigError({}, key, error.what());
  }
}

}  // namespace

const Table& BarkOptions::fields() {
  static const Table table = make_table<BarkOptions>({
      {"kind",
       &BarkOptions::kind,
       {.help = "plain: a colour alone; ridged as oak; smooth with lenticels as beech; plated as pine",
        .choices = {"plain", "ridged", "smooth", "plated"}}},
      {"image", &BarkOptions::image, {.help = "PNG or JPEG instead of the kind's texture; it should tile"}},
      {"normal", &BarkOptions::normal, {.help = "PNG or JPEG, the normal map that goes with image"}},
      {"tile_width",
       &BarkOptions::tile_width,
       {.min = 0.001,
        .max = 100,
        .unit = "m",
        .help = "how wide the texture is on a trunk, at most a third of its girth"}},
      {"resolution",
       &BarkOptions::resolution,
       {.min = 16, .max = 4096, .unit = "pixels", .help = "side of the kind's texture"}},
  });
  return table;
}

std::vector<float> bark_repeats(const Skeleton& skeleton, double tile_width) {
  const double thickest = *std::max_element(skeleton.diameter.begin(), skeleton.diameter.end());
  const double trunk_tile = std::min(tile_width, std::numbers::pi * thickest / kLeastAroundTrunk);
  std::vector<float> repeats(skeleton.node_count(), 1.0f);
  const Axes axes = find_axes(skeleton);
  for (const Axis& axis : axes.list) {
    if (axis.count == 0) continue;
    const std::uint32_t parent = axes.points[axis.first].node;
    const std::uint32_t node = axes.points[axis.first + 1].node;
    const double bearer_tile = std::numbers::pi * skeleton.diameter[parent] / repeats[parent];
    const double tile = skeleton.is_root(parent) ? trunk_tile : bearer_tile;
    const double girth = std::numbers::pi * skeleton.diameter[node];
    const auto times = static_cast<float>(tile > 0.0 ? std::max(1.0, std::round(girth / tile)) : 1.0);
    if (skeleton.is_root(parent)) repeats[parent] = std::max(repeats[parent], times);
    for (std::uint32_t point = axis.first + 1; point < axis.end(); ++point)
      repeats[axes.points[point].node] = times;
  }
  return repeats;
}

void check_bark(const BarkOptions& options) {
  check_image(options.image, "image");
  check_image(options.normal, "normal");
  if (!options.normal.empty() && options.image.empty()) {
    throw ConfigError({}, "normal", "a normal map without bark.image (name the image that it goes with)");
  }
}

void dress_in_bark(Mesh& mesh, const Skeleton& skeleton, const BarkOptions& options) {
  const auto bark = std::find_if(mesh.materials.begin(), mesh.materials.end(),
                                 [](const Material& material) { return material.name == "bark"; });
  if (bark == mesh.materials.end()) return;
  double mean_shade = 1.0;
  set_texture(*bark, options, mean_shade);

  const BarkColors colors(skeleton, options.kind, mean_shade);
  const std::vector<float> repeats = bark_repeats(skeleton, options.tile_width);
  const bool has_colors = options.image.empty();
  if (has_colors) {
    mesh.colors.reserve(mesh.positions.capacity());
    mesh.colors.resize(mesh.vertex_count());
  }
  parallel_for(mesh.vertex_count(), 1 << 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t vertex = begin; vertex < end; ++vertex) {
      const std::uint32_t node = mesh.internodes[vertex];
      if (has_colors) mesh.colors[vertex] = colors.at(node, mesh.positions[vertex]);
      mesh.uvs[vertex] *= repeats[node];
    }
  });
}

}  // namespace ramify
