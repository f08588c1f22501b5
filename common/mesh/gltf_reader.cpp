#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "common/base/color.h"
#include "common/base/errors.h"
#include "common/mesh/fork_bark.h"
#include "common/mesh/gltf.h"
#include "common/mesh/normals.h"

namespace ramify {
namespace {

/// Reads accessor values as T, checking every offset: files are not to be trusted.
template <class T>
std::vector<T> accessor_values(const tinygltf::Model& model, int index, int type, const std::string& name) {
  const auto fail = [&](const char* what) {
    throw InputError(fmt::format("{}: accessor {}: {}", name, index, what));
  };
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size()) fail("is not in the file");
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  if (accessor.type != type) fail("has an unexpected type");
  if (accessor.bufferView < 0 || static_cast<std::size_t>(accessor.bufferView) >= model.bufferViews.size()) {
    fail("has no buffer view (sparse accessors are not read)");
  }
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size()) fail("has no buffer");
  const std::vector<unsigned char>& bytes = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  const int stride = accessor.ByteStride(view);
  if (stride < static_cast<int>(sizeof(T))) fail("has elements of another size");
  const std::size_t first = view.byteOffset + accessor.byteOffset;
  const std::size_t room = first <= bytes.size() ? bytes.size() - first : 0;
  const auto step = static_cast<std::size_t>(stride);
  if (accessor.count > 0 && (room < sizeof(T) || (room - sizeof(T)) / step < accessor.count - 1)) {
    fail("reaches past the end of its buffer");
  }
  std::vector<T> values(accessor.count);
  for (std::size_t i = 0; i < values.size(); ++i)
    std::memcpy(&values[i], &bytes[first + i * step], sizeof(T));
  return values;
}

std::vector<std::uint32_t> indices(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                   std::size_t vertices, const std::string& name) {
  std::vector<std::uint32_t> result;
  if (primitive.indices < 0) {
    for (std::size_t i = 0; i < vertices; ++i) result.push_back(static_cast<std::uint32_t>(i));
    return result;
  }
  const auto index = static_cast<std::size_t>(primitive.indices);
  const int component = index < model.accessors.size() ? model.accessors[index].componentType : 0;
  const auto widen = [&](const auto& narrow) { result.assign(narrow.begin(), narrow.end()); };
  if (component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) {
    widen(accessor_values<std::uint8_t>(model, primitive.indices, TINYGLTF_TYPE_SCALAR, name));
  } else if (component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) {
    widen(accessor_values<std::uint16_t>(model, primitive.indices, TINYGLTF_TYPE_SCALAR, name));
  } else {
    widen(accessor_values<std::uint32_t>(model, primitive.indices, TINYGLTF_TYPE_SCALAR, name));
  }
  for (const std::uint32_t vertex : result) {
    if (vertex >= vertices) {
      throw InputError(fmt::format("{}: vertex {} in a triangle (0 to {})", name, vertex, vertices));
    }
  }
  return result;
}

/// One to four numbers a vertex, whole ones as parts of their greatest value; the components that the file
/// lacks are those of `otherwise`.
std::vector<glm::vec4> unit_vectors(const tinygltf::Model& model, int index, const glm::vec4& otherwise,
                                    const std::string& name) {
  const bool is_there = index >= 0 && static_cast<std::size_t>(index) < model.accessors.size();
  const tinygltf::Accessor accessor =
      is_there ? model.accessors[static_cast<std::size_t>(index)] : tinygltf::Accessor();
  const int count = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  std::vector<glm::vec4> result;
  const auto widen = [&](const auto& rows, float greatest) {
    result.assign(rows.size(), otherwise);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (int axis = 0; axis < rows[i].length(); ++axis) {
        result[i][axis] = static_cast<float>(rows[i][axis]) / greatest;
      }
    }
  };
  const auto read = [&]<class T>(T, float greatest) {
    if (count == 2) widen(accessor_values<glm::vec<2, T>>(model, index, accessor.type, name), greatest);
    if (count == 3) widen(accessor_values<glm::vec<3, T>>(model, index, accessor.type, name), greatest);
    if (count == 4) widen(accessor_values<glm::vec<4, T>>(model, index, accessor.type, name), greatest);
  };
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      read(std::uint8_t{}, 255.0f);
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      read(std::uint16_t{}, 65535.0f);
      break;
    default:
      read(float{}, 1.0f);
  }
  if (result.empty()) throw InputError(fmt::format("{}: accessor {}: has an unexpected type", name, index));
  return result;
}

std::uint8_t byte_of(float part) {
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(part, 0.0f, 1.0f)));
}

/// Puts the primitives of a file's meshes together as one mesh.
class MeshAssembler {
 public:
  MeshAssembler(const tinygltf::Model& model, const std::string& name) : model_(model), name_(name) {}

  void add_materials() {
    for (const tinygltf::Material& source : model_.materials) {
      Material material;
      material.name = source.name;
      const std::vector<double>& color = source.pbrMetallicRoughness.baseColorFactor;
      if (color.size() >= 3) material.color = {color[0], color[1], color[2]};
      material.roughness = static_cast<float>(source.pbrMetallicRoughness.roughnessFactor);
      material.image = image(source.pbrMetallicRoughness.baseColorTexture.index);
      material.normal_map = image(source.normalTexture.index);
      material.is_overlay = source.alphaMode == "BLEND" && source.name == kForkBark;
      material.is_cutout = source.alphaMode != "OPAQUE" && !material.is_overlay;
      material.is_two_sided = source.doubleSided;
      mesh_.materials.push_back(std::move(material));
    }
    mesh_.materials.emplace_back();  // of primitives that name none
  }

  /// Walks the default scene; all meshes as they are where there is no scene.
  void add_scene() {
    if (model_.scenes.empty()) {
      for (std::size_t i = 0; i < model_.meshes.size(); ++i) add_mesh(static_cast<int>(i), glm::dmat4(1.0));
      return;
    }
    const int scene = std::clamp(model_.defaultScene, 0, static_cast<int>(model_.scenes.size()) - 1);
    std::vector<std::pair<int, glm::dmat4>> pending;
    for (const int node : model_.scenes[static_cast<std::size_t>(scene)].nodes) {
      pending.emplace_back(node, glm::dmat4(1.0));
    }
    std::set<int> seen;
    while (!pending.empty()) {
      const auto [index, parent] = pending.back();
      pending.pop_back();
      const bool is_there = index >= 0 && static_cast<std::size_t>(index) < model_.nodes.size();
      if (!is_there || !seen.insert(index).second) {
        throw InputError(fmt::format("{}: node {} is not in the file or has two parents", name_, index));
      }
      const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(index)];
      const glm::dmat4 to_world = parent * transform_of(node);
      if (node.mesh >= 0) add_mesh(node.mesh, to_world);
      for (const int child : node.children) pending.emplace_back(child, to_world);
    }
  }

  Mesh finished() {
    const bool has_default = std::any_of(mesh_.ranges.begin(), mesh_.ranges.end(), [&](const auto& range) {
      return range.material + 1 == mesh_.materials.size();
    });
    if (!has_default) mesh_.materials.pop_back();
    keep_last_overlays();
    return std::move(mesh_);
  }

 private:
  /// An overlay that another program has put before other surfaces is none any more.
  void keep_last_overlays() {
    bool is_last = true;
    for (auto range = mesh_.ranges.rbegin(); range != mesh_.ranges.rend(); ++range) {
      Material& material = mesh_.materials[range->material];
      is_last = is_last && material.is_overlay;
      if (is_last || !material.is_overlay) continue;
      material.is_overlay = false;
      material.is_cutout = true;
    }
  }

  Image image(int texture) const {
    if (texture < 0 || static_cast<std::size_t>(texture) >= model_.textures.size()) return {};
    const int source = model_.textures[static_cast<std::size_t>(texture)].source;
    if (source < 0 || static_cast<std::size_t>(source) >= model_.images.size()) return {};
    const tinygltf::Image& stored = model_.images[static_cast<std::size_t>(source)];
    if (stored.image.empty()) return {};
    return {stored.width, stored.height, stored.image};
  }

  static glm::dmat4 transform_of(const tinygltf::Node& node) {
    glm::dmat4 matrix(1.0);
    if (node.matrix.size() == 16) {
      for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
      return matrix;
    }
    if (node.rotation.size() == 4) {
      const Vec3 axis(node.rotation[0], node.rotation[1], node.rotation[2]);
      const double w = node.rotation[3];
      for (int column = 0; column < 3; ++column) {
        Vec3 unit(0.0);
        unit[column] = 1.0;
        const Vec3 turned = unit + 2.0 * glm::cross(axis, glm::cross(axis, unit) + w * unit);
        matrix[column] = glm::dvec4(turned, 0.0);
      }
    }
    if (node.scale.size() == 3) {
      for (int column = 0; column < 3; ++column)
        matrix[column] *= node.scale[static_cast<std::size_t>(column)];
    }
    if (node.translation.size() == 3) {
      matrix[3] = {node.translation[0], node.translation[1], node.translation[2], 1.0};
    }
    return matrix;
  }

  void add_mesh(int index, const glm::dmat4& to_world) {
    if (static_cast<std::size_t>(index) >= model_.meshes.size()) {
      throw InputError(fmt::format("{}: mesh {} is not in the file", name_, index));
    }
    for (const tinygltf::Primitive& primitive : model_.meshes[static_cast<std::size_t>(index)].primitives) {
      add_primitive(primitive, to_world);
    }
  }

  void add_primitive(const tinygltf::Primitive& primitive, const glm::dmat4& to_world) {
    const bool is_triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode < 0;
    const auto position = primitive.attributes.find("POSITION");
    if (!is_triangles || position == primitive.attributes.end()) return;
    const auto positions = accessor_values<Vec3f>(model_, position->second, TINYGLTF_TYPE_VEC3, name_);
    const auto corners = indices(model_, primitive, positions.size(), name_);

    const auto base = static_cast<std::uint32_t>(mesh_.positions.size());
    const std::size_t first_triangle = mesh_.triangles.size();
    for (const Vec3f& p : positions) {
      mesh_.positions.push_back(is_identity(to_world) ? p : Vec3f(to_world * glm::dvec4(p, 1.0)));
    }
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      mesh_.triangles.push_back({base + corners[i], base + corners[i + 1], base + corners[i + 2]});
    }
    add_attributes(primitive, positions.size(), first_triangle, to_world);
    const bool is_known =
        primitive.material >= 0 && static_cast<std::size_t>(primitive.material) + 1 < mesh_.materials.size();
    const std::size_t material =
        is_known ? static_cast<std::size_t>(primitive.material) : mesh_.materials.size() - 1;
    mesh_.ranges.push_back({material, first_triangle, mesh_.triangles.size() - first_triangle});
  }

  static bool is_identity(const glm::dmat4& matrix) { return matrix == glm::dmat4(1.0); }

  void add_attributes(const tinygltf::Primitive& primitive, std::size_t count, std::size_t first_triangle,
                      const glm::dmat4& to_world) {
    const std::size_t total = mesh_.positions.size();
    const auto index_of = [&](const char* attribute) {
      const auto found = primitive.attributes.find(attribute);
      return found == primitive.attributes.end() ? -1 : found->second;
    };
    if (index_of("NORMAL") >= 0) {
      auto normals = accessor_values<Vec3f>(model_, index_of("NORMAL"), TINYGLTF_TYPE_VEC3, name_);
      if (!is_identity(to_world)) {
        const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(to_world)));
        for (Vec3f& normal : normals) normal = Vec3f(normalized_or(turn * Vec3(normal), kUp));
      }
      normals.resize(count, Vec3f(kUp));
      mesh_.normals.insert(mesh_.normals.end(), normals.begin(), normals.end());
    } else {
      compute_normals(mesh_, total - count, first_triangle);
    }

    if (index_of("TEXCOORD_0") >= 0) {
      for (const glm::vec4& uv : unit_vectors(model_, index_of("TEXCOORD_0"), glm::vec4(0.0f), name_)) {
        mesh_.uvs.emplace_back(uv.x, 1.0f - uv.y);  // glTF counts from the upper edge
      }
    }
    mesh_.uvs.resize(total, Vec2f(0, 0));

    if (index_of("COLOR_0") >= 0) {
      mesh_.colors.resize(total - count, {255, 255, 255, 255});
      for (const glm::vec4& c : unit_vectors(model_, index_of("COLOR_0"), glm::vec4(1.0f), name_)) {
        mesh_.colors.push_back(
            {byte_of(encoded_of(c.r)), byte_of(encoded_of(c.g)), byte_of(encoded_of(c.b)), byte_of(c.a)});
      }
    }
    if (!mesh_.colors.empty()) mesh_.colors.resize(total, {255, 255, 255, 255});
  }

  const tinygltf::Model& model_;
  const std::string& name_;
  Mesh mesh_;
};

/// What the library calls with an image's bytes; `user` is the file's name.
bool load_image(tinygltf::Image* image, const int index, std::string* error, std::string*, int, int,
                const unsigned char* bytes, int size, void* user) {
  try {
    const std::string name = fmt::format("{}: image {}", *static_cast<const std::string*>(user), index);
    Image decoded =
        decoded_image({reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size)}, name);
    image->width = decoded.width;
    image->height = decoded.height;
    image->component = 4;
    image->bits = 8;
    image->pixel_type = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    image->image = std::move(decoded.rgba);
    return true;
  } catch (const InputError& failure) {
    *error = failure.what();
    return false;
  }
}

}  // namespace

Mesh read_gltf(const std::string& bytes, const std::string& name) {
  tinygltf::TinyGLTF reader;
  std::string called = name;
  reader.SetImageLoader(load_image, &called);
  tinygltf::Model model;
  std::string error;
  std::string warning;
  const bool is_binary = bytes.rfind("glTF", 0) == 0;
  const auto size = static_cast<unsigned int>(bytes.size());
  const bool is_read =
      is_binary ? reader.LoadBinaryFromMemory(&model, &error, &warning,
                                              reinterpret_cast<const unsigned char*>(bytes.data()), size)
                : reader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, "");
  if (!is_read) {
    std::replace(error.begin(), error.end(), '\n', ' ');
    throw InputError(fmt::format("{}: no glTF: {}", name, error));
  }
  MeshAssembler assembler(model, name);
  assembler.add_materials();
  assembler.add_scene();
  return assembler.finished();
}

}  // namespace ramify
