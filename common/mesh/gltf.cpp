#include "common/mesh/gltf.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "common/base/errors.h"

namespace ramify {
namespace {

/// Copies `values` to the end of the model's buffer and describes them; returns the accessor's index.
template <class Values>
int add_accessor(tinygltf::Model& model, const Values& values, int target, int type, int component) {
  std::vector<unsigned char>& bytes = model.buffers[0].data;
  const std::size_t size = values.size() * sizeof(values[0]);
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = bytes.size();
  view.byteLength = size;
  view.target = target;
  const auto* first = reinterpret_cast<const unsigned char*>(values.data());
  bytes.insert(bytes.end(), first, first + size);
  model.bufferViews.push_back(view);

  tinygltf::Accessor accessor;
  accessor.bufferView = static_cast<int>(model.bufferViews.size()) - 1;
  accessor.componentType = component;
  accessor.type = type;
  accessor.count = values.size() * sizeof(values[0]) / (4 * tinygltf::GetNumComponentsInType(type));
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
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

tinygltf::Material gltf_material(const Material& material) {
  tinygltf::Material result;
  result.name = material.name;
  const Vec3f& color = material.color;
  result.pbrMetallicRoughness.baseColorFactor = {color.r, color.g, color.b, 1.0};
  result.pbrMetallicRoughness.metallicFactor = 0.0;
  result.pbrMetallicRoughness.roughnessFactor = material.roughness;
  result.doubleSided = material.is_two_sided;
  return result;
}

void add_mesh(tinygltf::Model& model, const Mesh& mesh) {
  model.buffers.emplace_back();
  const std::size_t vertex_bytes = sizeof(Vec3f) * 2 + sizeof(Vec2f);
  model.buffers[0].data.reserve(mesh.vertex_count() * vertex_bytes + mesh.triangles.size() * 12);
  const int positions = add_accessor(model, mesh.positions, TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_TYPE_VEC3,
                                     TINYGLTF_COMPONENT_TYPE_FLOAT);
  set_bounds(model.accessors.back(), mesh.positions);
  const int normals = add_accessor(model, mesh.normals, TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_TYPE_VEC3,
                                   TINYGLTF_COMPONENT_TYPE_FLOAT);
  const int uvs = add_accessor(model, mesh.uvs, TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_TYPE_VEC2,
                               TINYGLTF_COMPONENT_TYPE_FLOAT);
  tinygltf::Mesh tree;
  tree.name = "tree";
  for (const MaterialRange& range : mesh.ranges) {
    const auto first = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(range.first_triangle);
    const std::vector<std::array<std::uint32_t, 3>> triangles(
        first, first + static_cast<std::ptrdiff_t>(range.triangle_count));
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes = {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}};
    primitive.indices = add_accessor(model, triangles, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER,
                                     TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
    primitive.material = static_cast<int>(range.material);
    tree.primitives.push_back(primitive);
  }
  for (const Material& material : mesh.materials) model.materials.push_back(gltf_material(material));
  model.meshes.push_back(tree);
}

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

void append_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive, Mesh& mesh,
                      const std::string& name) {
  const bool is_triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode < 0;
  const auto position = primitive.attributes.find("POSITION");
  if (!is_triangles || position == primitive.attributes.end()) return;
  const auto positions = accessor_values<Vec3f>(model, position->second, TINYGLTF_TYPE_VEC3, name);
  const auto corners = indices(model, primitive, positions.size(), name);

  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  const std::size_t first_triangle = mesh.triangles.size();
  mesh.positions.insert(mesh.positions.end(), positions.begin(), positions.end());
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    mesh.triangles.push_back({base + corners[i], base + corners[i + 1], base + corners[i + 2]});
  }
  const auto normal = primitive.attributes.find("NORMAL");
  std::vector<Vec3f> normals;
  if (normal != primitive.attributes.end()) {
    normals = accessor_values<Vec3f>(model, normal->second, TINYGLTF_TYPE_VEC3, name);
  }
  normals.resize(positions.size(), Vec3f(0, 1, 0));
  mesh.normals.insert(mesh.normals.end(), normals.begin(), normals.end());
  mesh.uvs.resize(mesh.positions.size(), Vec2f(0, 0));
  mesh.ranges.push_back({0, first_triangle, mesh.triangles.size() - first_triangle});
}

}  // namespace

void write_gltf(const Mesh& mesh, const Provenance& provenance, GltfForm form, std::ostream& out) {
  const std::size_t bytes =
      mesh.vertex_count() * (sizeof(Vec3f) * 2 + sizeof(Vec2f)) + mesh.triangles.size() * 12;
  // Sizes in the binary form are 32-bit; a megabyte is left for the JSON part.
  if (bytes > 0xffffffffu - (1u << 20)) {
    throw RunError(
        fmt::format("the mesh has {} bytes, too large for glTF (4 GiB): write .ply or .obj", bytes));
  }
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "ramify " + provenance.version;
  tinygltf::Value::Object origin;
  origin["version"] = tinygltf::Value(provenance.version);
  origin["engine"] = tinygltf::Value(provenance.engine);
  // As text: a JSON number holds only 53 bits of a seed.
  origin["seed"] = tinygltf::Value(std::to_string(provenance.seed));
  origin["steps"] = tinygltf::Value(provenance.steps);
  origin["config"] = tinygltf::Value(provenance.config);
  model.asset.extras = tinygltf::Value(tinygltf::Value::Object{{"ramify", tinygltf::Value(origin)}});

  tinygltf::Node node;
  node.name = "tree";
  if (!mesh.triangles.empty()) {
    add_mesh(model, mesh);
    node.mesh = 0;
  }
  model.nodes.push_back(node);
  tinygltf::Scene scene;
  scene.nodes.push_back(0);
  model.scenes.push_back(scene);
  model.defaultScene = 0;
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, out, true, form == GltfForm::binary);
}

Mesh read_gltf(const std::string& bytes, const std::string& name) {
  tinygltf::TinyGLTF reader;
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
  Mesh mesh;
  mesh.materials.resize(1);
  mesh.materials[0].name = "bark";
  for (const tinygltf::Mesh& part : model.meshes) {
    for (const tinygltf::Primitive& primitive : part.primitives)
      append_primitive(model, primitive, mesh, name);
  }
  return mesh;
}

}  // namespace ramify
