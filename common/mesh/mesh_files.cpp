#include "common/mesh/mesh_files.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/mesh/gltf.h"
#include "common/mesh/normals.h"

namespace ramify {
namespace {

namespace fs = std::filesystem;

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

/// The name that follows "mtllib" in an OBJ; empty if there is none.
std::string library_name(const std::string& text) {
  std::size_t begin = text.rfind("mtllib ", 0) == 0 ? 0 : text.find("\nmtllib ");
  if (begin == std::string::npos) return {};
  begin = text.find(' ', begin) + 1;
  std::string name = text.substr(begin, text.find_first_of("\r\n", begin) - begin);
  name.erase(name.find_last_not_of(' ') + 1);
  return name;
}

/// The image beside the OBJ; empty if `name` is.
Image image_beside(const fs::path& obj, const std::string& name) {
  if (name.empty()) return {};
  const fs::path path = obj.parent_path() / name;
  return decoded_image(read_file(path), path.string());
}

Material material_of(const tinyobj::material_t& source, const fs::path& obj) {
  Material material;
  material.name = source.name;
  material.color = {source.diffuse[0], source.diffuse[1], source.diffuse[2]};
  material.image = image_beside(obj, source.diffuse_texname);
  material.normal_map = image_beside(obj, source.normal_texname);
  material.is_cutout = !source.alpha_texname.empty();
  material.is_two_sided = true;
  if (!material.is_cutout || source.alpha_texname == source.diffuse_texname) return material;

  // Transparency from an image of its own goes into the colours' alpha.
  const Image alpha = image_beside(obj, source.alpha_texname);
  Image& image = material.image;
  if (image.is_empty())
    image = {alpha.width, alpha.height, std::vector<std::uint8_t>(alpha.rgba.size(), 255)};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * image.width + static_cast<std::size_t>(x);
      image.rgba[4 * pixel + 3] =
          alpha.pixel(x * alpha.width / image.width, y * alpha.height / image.height)[0];
    }
  }
  return material;
}

/// Makes one vertex of each combination of indices that the faces use.
class ObjAssembler {
 public:
  ObjAssembler(const tinyobj::ObjReader& reader, const std::string& name)
      : attributes_(reader.GetAttrib()), shapes_(reader.GetShapes()), name_(name) {}

  /// Triangles of material -1, which is none, come last.
  Mesh mesh(std::vector<Material> materials) {
    std::vector<std::vector<std::array<std::uint32_t, 3>>> by_material(materials.size() + 1);
    for (const tinyobj::shape_t& shape : shapes_) {
      const std::vector<tinyobj::index_t>& corners = shape.mesh.indices;
      for (std::size_t face = 0; 3 * face + 2 < corners.size(); ++face) {
        const int id = face < shape.mesh.material_ids.size() ? shape.mesh.material_ids[face] : -1;
        const bool is_known = id >= 0 && static_cast<std::size_t>(id) < materials.size();
        by_material[is_known ? static_cast<std::size_t>(id) : materials.size()].push_back(
            {vertex(corners[3 * face]), vertex(corners[3 * face + 1]), vertex(corners[3 * face + 2])});
      }
    }
    materials.emplace_back().is_two_sided = true;
    for (std::size_t i = 0; i < by_material.size(); ++i) {
      if (by_material[i].empty()) continue;
      mesh_.ranges.push_back({mesh_.materials.size(), mesh_.triangles.size(), by_material[i].size()});
      mesh_.materials.push_back(std::move(materials[i]));
      mesh_.triangles.insert(mesh_.triangles.end(), by_material[i].begin(), by_material[i].end());
    }
    if (!has_normals_) compute_normals(mesh_);
    return std::move(mesh_);
  }

 private:
  std::uint32_t vertex(const tinyobj::index_t& corner) {
    const auto key = std::tuple(corner.vertex_index, corner.normal_index, corner.texcoord_index);
    const auto [found, is_new] = known_.try_emplace(key, static_cast<std::uint32_t>(mesh_.vertex_count()));
    if (!is_new) return found->second;
    mesh_.positions.emplace_back(number(attributes_.vertices, corner.vertex_index, 3, 0),
                                 number(attributes_.vertices, corner.vertex_index, 3, 1),
                                 number(attributes_.vertices, corner.vertex_index, 3, 2));
    mesh_.uvs.emplace_back(0.0f);
    if (corner.texcoord_index >= 0) {
      mesh_.uvs.back() = {number(attributes_.texcoords, corner.texcoord_index, 2, 0),
                          number(attributes_.texcoords, corner.texcoord_index, 2, 1)};
    }
    mesh_.normals.emplace_back(0.0f);
    has_normals_ = has_normals_ && corner.normal_index >= 0;
    if (corner.normal_index >= 0) {
      mesh_.normals.back() = {number(attributes_.normals, corner.normal_index, 3, 0),
                              number(attributes_.normals, corner.normal_index, 3, 1),
                              number(attributes_.normals, corner.normal_index, 3, 2)};
    }
    return found->second;
  }

  float number(const std::vector<tinyobj::real_t>& values, int index, std::size_t components,
               std::size_t axis) const {
    const std::size_t count = values.size() / components;
    if (index < 0 || static_cast<std::size_t>(index) >= count) {
      throw InputError(fmt::format("{}: a face has corner {} of {}", name_, index + 1, count));
    }
    const float value = values[static_cast<std::size_t>(index) * components + axis];
    if (!std::isfinite(value)) throw InputError(fmt::format("{}: a number is not finite", name_));
    return value;
  }

  const tinyobj::attrib_t& attributes_;
  const std::vector<tinyobj::shape_t>& shapes_;
  const std::string& name_;
  std::map<std::tuple<int, int, int>, std::uint32_t> known_;
  bool has_normals_ = true;
  Mesh mesh_;
};

Mesh read_obj(const std::string& text, const fs::path& path) {
  const std::string name = path.string();
  const std::string library = library_name(text);
  const std::string materials_text = library.empty() ? "" : read_file(path.parent_path() / library);
  tinyobj::ObjReaderConfig config;
  config.vertex_color = false;
  tinyobj::ObjReader reader;
  if (!reader.ParseFromString(text, materials_text, config)) {
    throw InputError(fmt::format("{}: no OBJ: {}", name, one_line(reader.Error())));
  }
  std::vector<Material> materials;
  for (const tinyobj::material_t& material : reader.GetMaterials()) {
    materials.push_back(material_of(material, path));
  }
  return ObjAssembler(reader, name).mesh(std::move(materials));
}

}  // namespace

Mesh read_mesh(const fs::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".glb" || ending == ".gltf") return read_gltf(read_file(path), path.string());
  if (ending == ".obj") return read_obj(read_file(path), path);
  throw InputError(fmt::format("{}: unknown ending '{}' (.glb .gltf .obj)", path.string(), ending));
}

}  // namespace ramify
