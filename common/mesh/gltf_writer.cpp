#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <span>
#include <sstream>

#include "common/base/base64.h"
#include "common/base/color.h"
#include "common/base/errors.h"
#include "common/base/parallel.h"
#include "common/mesh/gltf.h"

namespace ramify {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF's buffers are written as memory has them");

using Sink = std::function<void(const void* bytes, std::size_t count)>;

/// The binary buffer: what the JSON describes and how it is written, view by view, out of the mesh's own
/// arrays. Nothing is held twice.
class BinaryPart {
 public:
  explicit BinaryPart(tinygltf::Model& model) : model_(model) {}

  /// Adds a view of `bytes` bytes that `write` will send off; returns its index.
  int add_view(std::size_t bytes, int target, std::function<void(const Sink&)> write) {
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = size_;
    view.byteLength = bytes;
    view.target = target;
    model_.bufferViews.push_back(view);
    stretches_.push_back({bytes, std::move(write)});
    size_ += padded(bytes);
    return static_cast<int>(model_.bufferViews.size()) - 1;
  }

  std::size_t size() const { return size_; }

  void write(const Sink& sink) const {
    constexpr std::array<char, 4> kPadding{};
    for (const Stretch& stretch : stretches_) {
      stretch.write(sink);
      if (padded(stretch.bytes) > stretch.bytes) sink(kPadding.data(), padded(stretch.bytes) - stretch.bytes);
    }
  }

 private:
  struct Stretch {
    std::size_t bytes;
    std::function<void(const Sink&)> write;
  };

  static std::size_t padded(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

  tinygltf::Model& model_;
  std::vector<Stretch> stretches_;
  std::size_t size_ = 0;
};

/// The vertices that a range of triangles uses: first to last, of which the mesher leaves no gaps.
struct Window {
  std::uint32_t first = 0;
  std::size_t count = 0;
};

Window window_of(const Mesh& mesh, const MaterialRange& range) {
  std::uint32_t low = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t high = 0;
  for (std::size_t i = range.first_triangle; i < range.first_triangle + range.triangle_count; ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      low = std::min(low, vertex);
      high = std::max(high, vertex);
    }
  }
  return {low, std::size_t{high} - low + 1};
}

int add_accessor(tinygltf::Model& model, int view, std::size_t count, int type, int component) {
  tinygltf::Accessor accessor;
  accessor.bufferView = view;
  accessor.componentType = component;
  accessor.type = type;
  accessor.count = count;
  accessor.normalized = component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

template <class T>
int add_attribute(tinygltf::Model& model, BinaryPart& binary, const BulkVector<T>& values,
                  const Window& window, int type) {
  const T* first = values.data() + window.first;
  const std::size_t bytes = window.count * sizeof(T);
  const int view = binary.add_view(bytes, TINYGLTF_TARGET_ARRAY_BUFFER,
                                   [first, bytes](const Sink& sink) { sink(first, bytes); });
  return add_accessor(model, view, window.count, type, TINYGLTF_COMPONENT_TYPE_FLOAT);
}

void set_bounds(tinygltf::Accessor& accessor, std::span<const Vec3f> positions) {
  Vec3f low = positions.front();
  Vec3f high = positions.front();
  for (const Vec3f& p : positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  accessor.minValues = {low.x, low.y, low.z};
  accessor.maxValues = {high.x, high.y, high.z};
}

/// Sends convert(i) for i from 0 to count - 1 off in handy pieces.
template <class Convert>
void write_converted(std::size_t count, const Sink& sink, Convert convert) {
  constexpr std::size_t kRows = 8192;
  std::vector<decltype(convert(std::size_t{0}))> rows;
  rows.reserve(std::min(kRows, count));
  for (std::size_t begin = 0; begin < count; begin += kRows) {
    rows.clear();
    for (std::size_t i = begin; i < std::min(begin + kRows, count); ++i) rows.push_back(convert(i));
    sink(rows.data(), rows.size() * sizeof(rows[0]));
  }
}

/// glTF's vertex colours are linear: 16 bits keep the dark ones apart.
const std::array<std::uint16_t, 256>& linear_shorts() {
  static const std::array<std::uint16_t, 256> kShorts = [] {
    std::array<std::uint16_t, 256> shorts{};
    for (std::size_t byte = 0; byte < shorts.size(); ++byte) {
      const float linear = linear_of(static_cast<float>(byte) / 255.0f);
      shorts[byte] = static_cast<std::uint16_t>(std::lround(65535.0f * linear));
    }
    return shorts;
  }();
  return kShorts;
}

int add_colors(tinygltf::Model& model, BinaryPart& binary, const Mesh& mesh, const Window& window) {
  using Shorts = std::array<std::uint16_t, 4>;
  const auto write = [&mesh, window](const Sink& sink) {
    const std::array<std::uint16_t, 256>& linear = linear_shorts();
    write_converted(window.count, sink, [&](std::size_t i) {
      const auto [r, g, b, a] = mesh.colors[window.first + i];
      return Shorts{linear[r], linear[g], linear[b], static_cast<std::uint16_t>(257 * a)};
    });
  };
  const int view = binary.add_view(window.count * sizeof(Shorts), TINYGLTF_TARGET_ARRAY_BUFFER, write);
  return add_accessor(model, view, window.count, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
}

/// glTF's v counts from the image's upper edge.
int add_uvs(tinygltf::Model& model, BinaryPart& binary, const Mesh& mesh, const Window& window) {
  const auto write = [&mesh, window](const Sink& sink) {
    write_converted(window.count, sink, [&](std::size_t i) {
      const Vec2f& uv = mesh.uvs[window.first + i];
      return Vec2f(uv.x, 1.0f - uv.y);
    });
  };
  const int view = binary.add_view(window.count * sizeof(Vec2f), TINYGLTF_TARGET_ARRAY_BUFFER, write);
  return add_accessor(model, view, window.count, TINYGLTF_TYPE_VEC2, TINYGLTF_COMPONENT_TYPE_FLOAT);
}

int add_indices(tinygltf::Model& model, BinaryPart& binary, const Mesh& mesh, const MaterialRange& range,
                const Window& window) {
  using Triangle = std::array<std::uint32_t, 3>;
  const Triangle* first = mesh.triangles.data() + range.first_triangle;
  const auto write = [first, count = range.triangle_count, base = window.first](const Sink& sink) {
    if (base == 0) return sink(first, count * sizeof(Triangle));
    write_converted(count, sink, [=](std::size_t i) {
      return Triangle{first[i][0] - base, first[i][1] - base, first[i][2] - base};
    });
  };
  const int view =
      binary.add_view(range.triangle_count * sizeof(Triangle), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, write);
  return add_accessor(model, view, 3 * range.triangle_count, TINYGLTF_TYPE_SCALAR,
                      TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
}

/// Those of leaves, which may have normal maps of their own, are not known.
bool has_tangents(const Mesh& mesh, const MaterialRange& range) {
  const Material& material = mesh.material(range);
  return !mesh.tangents.empty() && !material.normal_map.is_empty() &&
         (material.is_overlay || material.name == "bark");
}

void add_mesh(tinygltf::Model& model, BinaryPart& binary, const Mesh& mesh) {
  tinygltf::Mesh tree;
  tree.name = "tree";
  for (const MaterialRange& range : mesh.ranges) {
    if (range.triangle_count == 0) continue;
    const Window window = window_of(mesh, range);
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = static_cast<int>(range.material);
    primitive.attributes["POSITION"] =
        add_attribute(model, binary, mesh.positions, window, TINYGLTF_TYPE_VEC3);
    set_bounds(model.accessors.back(), std::span(mesh.positions).subspan(window.first, window.count));
    primitive.attributes["NORMAL"] = add_attribute(model, binary, mesh.normals, window, TINYGLTF_TYPE_VEC3);
    primitive.attributes["TEXCOORD_0"] = add_uvs(model, binary, mesh, window);
    if (has_tangents(mesh, range)) {
      // An overlay's are the last, whatever vertices without one come between.
      Window tangents = window;
      if (mesh.material(range).is_overlay)
        tangents.first = static_cast<std::uint32_t>(mesh.tangents.size() - window.count);
      primitive.attributes["TANGENT"] =
          add_attribute(model, binary, mesh.tangents, tangents, TINYGLTF_TYPE_VEC4);
    }
    if (!mesh.colors.empty()) primitive.attributes["COLOR_0"] = add_colors(model, binary, mesh, window);
    primitive.indices = add_indices(model, binary, mesh, range, window);
    tree.primitives.push_back(primitive);
  }
  model.meshes.push_back(tree);
}

/// Adds the image, compressed, as a texture that repeats; returns the texture's index.
int add_texture(tinygltf::Model& model, BinaryPart& binary, const std::string& name, std::string png) {
  tinygltf::Image image;
  image.name = name;
  image.mimeType = "image/png";
  const std::size_t bytes = png.size();
  image.bufferView =
      binary.add_view(bytes, 0, [png = std::move(png)](const Sink& sink) { sink(png.data(), png.size()); });
  model.images.push_back(image);
  tinygltf::Texture texture;
  texture.source = static_cast<int>(model.images.size()) - 1;
  texture.sampler = 0;
  model.textures.push_back(texture);
  return static_cast<int>(model.textures.size()) - 1;
}

/// The images of all materials, two each: image and normal map, empty where there is none.
std::vector<const Image*> images_of(const std::vector<Material>& materials) {
  std::vector<const Image*> images;
  for (const Material& material : materials) {
    images.push_back(&material.image);
    images.push_back(&material.normal_map);
  }
  return images;
}

/// Where in the list each image stands for the first time: overlays look like what they lie on.
std::vector<std::size_t> first_places(const std::vector<const Image*>& images) {
  std::vector<std::size_t> places;
  for (const Image* image : images) {
    const auto is_alike = [&](const Image* other) { return other->rgba == image->rgba; };
    const auto first = std::find_if(images.begin(), images.end(), is_alike);
    places.push_back(static_cast<std::size_t>(first - images.begin()));
  }
  return places;
}

/// The texture of each image; -1: none.
std::vector<int> add_textures(tinygltf::Model& model, BinaryPart& binary, const Mesh& mesh) {
  const std::vector<const Image*> images = images_of(mesh.materials);
  const std::vector<std::size_t> places = first_places(images);
  std::vector<std::string> pngs(images.size());
  parallel_for(images.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (places[i] == i && !images[i]->is_empty()) pngs[i] = png_bytes(*images[i]);
    }
  });
  if (std::any_of(pngs.begin(), pngs.end(), [](const std::string& png) { return !png.empty(); })) {
    tinygltf::Sampler sampler;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    model.samplers.push_back(sampler);
  }
  std::vector<int> textures(images.size(), -1);
  for (std::size_t i = 0; i < images.size(); ++i) {
    textures[i] = textures[places[i]];
    if (pngs[i].empty()) continue;
    const std::string& name = mesh.materials[i / 2].name;
    textures[i] = add_texture(model, binary, i % 2 == 0 ? name : name + " normals", std::move(pngs[i]));
  }
  return textures;
}

void add_materials(tinygltf::Model& model, BinaryPart& binary, const Mesh& mesh) {
  const std::vector<int> textures = add_textures(model, binary, mesh);
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    const Material& material = mesh.materials[i];
    tinygltf::Material result;
    result.name = material.name;
    const Vec3f& color = material.color;
    result.pbrMetallicRoughness.baseColorFactor = {color.r, color.g, color.b, 1.0};
    result.pbrMetallicRoughness.metallicFactor = 0.0;
    result.pbrMetallicRoughness.roughnessFactor = material.roughness;
    result.doubleSided = material.is_two_sided;
    if (material.is_cutout) result.alphaMode = "MASK";
    if (material.is_overlay) result.alphaMode = "BLEND";
    result.pbrMetallicRoughness.baseColorTexture.index = textures[2 * i];
    result.normalTexture.index = textures[2 * i + 1];
    model.materials.push_back(result);
  }
}

tinygltf::Value extras_of(const Provenance& provenance) {
  tinygltf::Value::Object origin;
  origin["version"] = tinygltf::Value(provenance.version);
  origin["engine"] = tinygltf::Value(provenance.engine);
  // As text: a JSON number holds only 53 bits of a seed.
  origin["seed"] = tinygltf::Value(std::to_string(provenance.seed));
  origin["steps"] = tinygltf::Value(provenance.steps);
  origin["config"] = tinygltf::Value(provenance.config);
  tinygltf::Value::Object metrics;
  for (const auto& [key, value] : provenance.metrics) metrics[key] = tinygltf::Value(value);
  if (!metrics.empty()) origin["metrics"] = tinygltf::Value(metrics);
  return tinygltf::Value(tinygltf::Value::Object{{"ramify", tinygltf::Value(origin)}});
}

/// The model as JSON without the opening brace: the buffer, which the library does not know of, comes first.
std::string json_after_buffers(const tinygltf::Model& model) {
  std::ostringstream out;
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, out, false, false);
  std::string json = std::move(out).str();
  while (!json.empty() && json.back() == '\n') json.pop_back();
  return json.substr(1);
}

void write_word(std::ostream& out, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  out.write(reinterpret_cast<const char*>(&word), sizeof word);
}

void write_binary(const BinaryPart& binary, std::string json, std::ostream& out) {
  constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
  constexpr std::uint32_t kBinChunk = 0x004e4942;
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t bin_size = binary.size();
  out << "glTF";
  write_word(out, 2);
  write_word(out, 12 + 8 + json.size() + (bin_size > 0 ? 8 + bin_size : 0));
  write_word(out, json.size());
  write_word(out, kJsonChunk);
  out << json;
  if (bin_size == 0) return;
  write_word(out, bin_size);
  write_word(out, kBinChunk);
  binary.write([&](const void* bytes, std::size_t count) {
    out.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(count));
  });
}

}  // namespace

void write_gltf(const Mesh& mesh, const Provenance& provenance, GltfForm form, std::ostream& out) {
  tinygltf::Model model;
  BinaryPart binary(model);
  model.asset.version = "2.0";
  model.asset.generator = "ramify " + provenance.version;
  model.asset.extras = extras_of(provenance);
  tinygltf::Node node;
  node.name = "tree";
  if (!mesh.triangles.empty()) {
    add_mesh(model, binary, mesh);
    add_materials(model, binary, mesh);
    node.mesh = 0;
  }
  model.nodes.push_back(node);
  tinygltf::Scene scene;
  scene.nodes.push_back(0);
  model.scenes.push_back(scene);
  model.defaultScene = 0;

  // Sizes in the binary form are 32-bit; a megabyte is left for the JSON part.
  if (binary.size() > 0xffffffffu - (1u << 20)) {
    throw RunError(
        fmt::format("the mesh has {} bytes, too large for glTF (4 GiB): write .ply or .obj", binary.size()));
  }
  const std::string rest = json_after_buffers(model);
  const std::string length = fmt::format("\"byteLength\":{}", binary.size());
  if (form == GltfForm::binary) {
    const std::string buffers = binary.size() > 0 ? fmt::format("\"buffers\":[{{{}}}],", length) : "";
    return write_binary(binary, "{" + buffers + rest, out);
  }
  out << "{";
  if (binary.size() > 0) {
    out << "\"buffers\":[{" << length << ",\"uri\":\"data:application/octet-stream;base64,";
    Base64Writer text(out);
    binary.write([&](const void* bytes, std::size_t count) { text.add(bytes, count); });
    text.finish();
    out << "\"}],";
  }
  out << rest << '\n';
}

}  // namespace ramify
