// glTF, OBJ, PLY and STL files.

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/base/decimal.h"

#include "common/base/errors.h"
#include "common/base/parallel.h"
#include "common/base/rng.h"
#include "common/mesh/gltf.h"
#include "common/mesh/mesher.h"
#include "common/mesh/obj.h"
#include "common/mesh/ply.h"
#include "common/mesh/stl.h"
#include "common/mesh/tree_mesh.h"
#include "common/skeleton/passes.h"
#include "tests/catch.h"
#include "tests/common/trees.h"

using namespace ramify;
using namespace ramify::test;

namespace {

const Provenance kProvenance{"1.2.3", "growth", 42, 7, "engine = \"growth\"\nseed = 42\n"};

std::string gltf_of(const Mesh& mesh, GltfForm form) {
  std::ostringstream out;
  write_gltf(mesh, kProvenance, form, out);
  return out.str();
}

nlohmann::json json_of(const std::string& glb) {
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  return nlohmann::json::parse(glb.substr(20, length));
}

std::string error_of(const std::string& bytes) {
  try {
    read_gltf(bytes, "a.glb");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::size_t lines_with(const std::string& text, const std::string& prefix) {
  std::istringstream lines(text);
  std::string line;
  std::size_t count = 0;
  while (std::getline(lines, line)) count += line.rfind(prefix, 0) == 0;
  return count;
}

}  // namespace

TEST_CASE("glTF: both forms read back to the same triangles") {
  const Mesh mesh = build_mesh(random_tree(1, 100), {});
  for (const GltfForm form : {GltfForm::binary, GltfForm::text}) {
    const Mesh again = read_gltf(gltf_of(mesh, form), "a");
    CHECK(again.positions == mesh.positions);
    CHECK(again.normals == mesh.normals);
    CHECK(again.triangles == mesh.triangles);
  }
}

TEST_CASE("glTF: materials, images, texture coordinates and colours read back") {
  Looks looks;
  looks.bark.resolution = 32;
  looks.leaves.shape = LeafShape::lobed;
  looks.leaves.max_width = 100.0;
  const Mesh mesh = make_tree_mesh(random_tree(1, 30), looks, 1).mesh;
  for (const GltfForm form : {GltfForm::binary, GltfForm::text}) {
    const Mesh again = read_gltf(gltf_of(mesh, form), "a");
    REQUIRE(again.materials.size() == 3);  // bark, leaves and bark over forks
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(again.materials[i].name == mesh.materials[i].name);
      CHECK(again.materials[i].image.rgba == mesh.materials[i].image.rgba);
      CHECK(again.materials[i].normal_map.rgba == mesh.materials[i].normal_map.rgba);
      CHECK(again.materials[i].is_cutout == mesh.materials[i].is_cutout);
      CHECK(again.materials[i].is_overlay == mesh.materials[i].is_overlay);
      CHECK(again.materials[i].is_two_sided == mesh.materials[i].is_two_sided);
      CHECK(again.materials[i].roughness == mesh.materials[i].roughness);
    }
    CHECK(again.positions == mesh.positions);
    CHECK(again.triangles == mesh.triangles);
    CHECK(again.colors == mesh.colors);
    REQUIRE(again.uvs.size() == mesh.uvs.size());
    for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
      CHECK(glm::distance(again.uvs[i], mesh.uvs[i]) < 1e-5f * (1.0f + glm::length(mesh.uvs[i])));
    }
  }
}

TEST_CASE("glTF: the JSON names cutouts, both sides, tangents and one image for each picture") {
  Looks looks;
  looks.bark.resolution = 32;
  looks.leaves.shape = LeafShape::ovate;
  looks.leaves.max_width = 100.0;
  const nlohmann::json json = json_of(gltf_of(make_tree_mesh(pole(4), looks, 1).mesh, GltfForm::binary));
  CHECK(json["images"].size() == 3);
  for (const auto& image : json["images"]) CHECK(image["mimeType"] == "image/png");
  CHECK(json["materials"][1]["name"] == "leaf");
  CHECK(json["materials"][1]["alphaMode"] == "MASK");
  CHECK(json["materials"][1]["doubleSided"] == true);
  CHECK(json["materials"][0].contains("normalTexture"));
  const auto& primitives = json["meshes"][0]["primitives"];
  REQUIRE(primitives.size() == 2);
  CHECK(primitives[0]["attributes"].contains("TANGENT"));
  CHECK(!primitives[1]["attributes"].contains("TANGENT"));
  for (const auto& primitive : primitives) CHECK(primitive["attributes"].contains("COLOR_0"));
}

TEST_CASE("glTF: a scene's transforms are applied") {
  nlohmann::json json = nlohmann::json::parse(gltf_of(build_mesh(pole(1), {}), GltfForm::text));
  json["nodes"][0]["translation"] = {1.0, 2.0, 3.0};
  json["nodes"][0]["rotation"] = {0.0, 0.0, std::sqrt(0.5), std::sqrt(0.5)};  // a quarter turn about z
  const Mesh plain = build_mesh(pole(1), {});
  const Mesh moved = read_gltf(json.dump(), "a");
  REQUIRE(moved.vertex_count() == plain.vertex_count());
  for (std::size_t i = 0; i < plain.vertex_count(); ++i) {
    const Vec3f& p = plain.positions[i];
    CHECK(glm::distance(moved.positions[i], Vec3f(1.0f - p.y, 2.0f + p.x, 3.0f + p.z)) < 1e-5f);
    const Vec3f& n = plain.normals[i];
    CHECK(glm::distance(moved.normals[i], Vec3f(-n.y, n.x, n.z)) < 1e-5f);
  }
  json["nodes"][0]["children"] = {0};
  CHECK(error_of(json.dump()) == "a.glb: node 0 is not in the file or has two parents");
}

TEST_CASE("glTF: the file carries what made it") {
  const nlohmann::json json = json_of(gltf_of(build_mesh(pole(3), {}), GltfForm::binary));
  const nlohmann::json& extras = json["asset"]["extras"]["ramify"];
  CHECK(extras["version"] == "1.2.3");
  CHECK(extras["engine"] == "growth");
  CHECK(extras["seed"] == "42");
  CHECK(extras["steps"] == 7);
  CHECK(extras["config"] == kProvenance.config);
  CHECK(json["materials"][0]["name"] == "bark");
}

TEST_CASE("glTF: a tree without triangles is a scene without mesh") {
  const std::string glb = gltf_of(Mesh{}, GltfForm::binary);
  CHECK(json_of(glb).count("meshes") == 0);
  CHECK(read_gltf(glb, "a").triangles.empty());
}

TEST_CASE("glTF: broken files are one line") {
  const std::string glb = gltf_of(build_mesh(pole(3), {}), GltfForm::binary);
  CHECK(error_of("").rfind("a.glb: no glTF: ", 0) == 0);
  CHECK(error_of("garbage").rfind("a.glb: no glTF: ", 0) == 0);
  for (std::size_t size :
       {std::size_t{4}, std::size_t{12}, std::size_t{30}, glb.size() / 2, glb.size() - 1}) {
    const std::string message = error_of(glb.substr(0, size));
    CHECK(message.rfind("a.glb: ", 0) == 0);
    CHECK(message.find('\n') == std::string::npos);
  }
}

TEST_CASE("glTF: an accessor that claims more than its buffer holds is refused") {
  std::string text = gltf_of(build_mesh(pole(3), {}), GltfForm::text);
  nlohmann::json json = nlohmann::json::parse(text);
  json["accessors"][0]["count"] = 1'000'000'000;
  CHECK(error_of(json.dump()).rfind("a.glb: ", 0) == 0);
  json = nlohmann::json::parse(text);
  json["accessors"][3]["count"] = 2'000'000;
  CHECK(error_of(json.dump()).rfind("a.glb: ", 0) == 0);
}

TEST_CASE("OBJ: counts, material and config are in the file") {
  const Mesh mesh = build_mesh(random_tree(2, 50), {});
  std::ostringstream out;
  write_obj(mesh, kProvenance, "tree.mtl", out);
  const std::string text = out.str();
  CHECK(lines_with(text, "v ") == mesh.vertex_count());
  CHECK(lines_with(text, "vn ") == mesh.vertex_count());
  CHECK(lines_with(text, "vt ") == mesh.vertex_count());
  CHECK(lines_with(text, "f ") == mesh.triangles.size());
  CHECK(lines_with(text, "mtllib tree.mtl") == 1);
  CHECK(lines_with(text, "#   seed = 42") == 1);
  std::ostringstream materials;
  write_mtl(mesh, "tree", materials);
  CHECK(lines_with(materials.str(), "newmtl bark") == 1);
}

TEST_CASE("OBJ: numbers are rounded to fixed places and read back as near") {
  const auto text_of = [](auto append, float value) {
    char text[decimal::kMaxLength];
    return std::string(text, append(text, value));
  };
  const auto six = [&](float value) { return text_of(append_decimal<6>, value); };
  CHECK(six(0.0f) == "0");
  CHECK(six(-0.0f) == "0");
  CHECK(six(-1e-9f) == "0");
  CHECK(six(0.5f) == "0.5");
  CHECK(six(-12.25f) == "-12.25");
  CHECK(six(3.0f) == "3");
  CHECK(six(0.9999999f) == "1");
  CHECK(six(123456.78f) == "123456.78125");
  CHECK(six(2e9f) == "2e+09");
  CHECK(six(std::numeric_limits<float>::infinity()) == "inf");
  CHECK(six(-999999936.0f).size() <= decimal::kMaxLength);
  Rng rng = Rng::stream(1, Stream::leaf, 0);
  for (int i = 0; i < 10000; ++i) {
    const auto value = static_cast<float>(rng.uniform(-50.0, 50.0));
    CHECK(std::abs(std::stof(six(value)) - value) <= 0.5001e-6 + 4e-6);
  }
}

TEST_CASE("OBJ: the same bytes for any number of threads, in more chunks than one") {
  Skeleton tree = random_tree(3, 20000);
  const Mesh mesh = build_mesh(tree, {});
  std::ostringstream many;
  write_obj(mesh, kProvenance, "a.mtl", many);
  const ThreadLimit limit(1);
  std::ostringstream one;
  write_obj(mesh, kProvenance, "a.mtl", one);
  CHECK(many.str() == one.str());
  CHECK(lines_with(one.str(), "f ") == mesh.triangles.size());
}

TEST_CASE(
    "OBJ: images stand beside the materials that name them, coloured as their vertices are on the whole") {
  Looks looks;
  looks.bark.resolution = 16;
  looks.leaves.shape = LeafShape::ovate;
  looks.leaves.max_width = 100.0;
  looks.leaves.color = {1.0, 0.0, 0.0};
  looks.leaves.color_jitter = 0.0;
  const Mesh mesh = make_tree_mesh(pole(3), looks, 1).mesh;
  std::ostringstream materials;
  write_mtl(mesh, "oak", materials);
  for (const std::string line :
       {"map_Kd oak-bark.png", "norm oak-bark-normal.png", "map_Kd oak-leaf.png", "map_d oak-leaf.png"}) {
    CHECK(lines_with(materials.str(), line) == 1);
  }
  const std::vector<ImageFile> files = image_files(mesh, "oak");
  REQUIRE(files.size() == 3);
  CHECK(files[0].name == "oak-bark.png");
  CHECK(files[1].name == "oak-bark-normal.png");
  CHECK(files[2].name == "oak-leaf.png");
  CHECK(files[2].image.rgba[0] == mesh.materials[1].image.rgba[0]);
  CHECK(files[2].image.rgba[1] == 0);
}

TEST_CASE("OBJ: faces count vertices from 1") {
  std::ostringstream out;
  write_obj(build_mesh(pole(1), {}), kProvenance, "a.mtl", out);
  CHECK(out.str().find("0/0/0") == std::string::npos);
  CHECK(out.str().find("f 1/1/1 2/2/2 ") != std::string::npos);
}

TEST_CASE("PLY: the header's counts are the bytes that follow") {
  const Mesh mesh = build_mesh(random_tree(3, 70), {});
  std::ostringstream out;
  write_ply(mesh, kProvenance, out);
  const std::string bytes = out.str();
  const std::size_t body = bytes.find("end_header\n") + 11;
  CHECK(bytes.size() - body == mesh.vertex_count() * 36 + mesh.triangles.size() * 13);
  CHECK(lines_with(bytes.substr(0, body), "element vertex " + std::to_string(mesh.vertex_count())) == 1);
  Vec3f first;
  std::memcpy(&first, bytes.data() + body, sizeof first);
  CHECK(first == mesh.positions[0]);
}

TEST_CASE("PLY: colours stand in every vertex, the config in comments") {
  Looks looks;
  looks.bark.kind = BarkKind::plain;
  const Mesh mesh = make_tree_mesh(pole(2), looks, 1).mesh;
  std::ostringstream out;
  write_ply(mesh, kProvenance, out);
  const std::string bytes = out.str();
  const std::size_t body = bytes.find("end_header\n") + 11;
  const std::string header = bytes.substr(0, body);
  for (const char* color : {"red", "green", "blue"}) {
    CHECK(lines_with(header, std::string("property uchar ") + color) == 1);
  }
  CHECK(lines_with(header, "comment   seed = 42") == 1);
  CHECK(bytes.size() - body == mesh.vertex_count() * 40 + mesh.triangles.size() * 13);
  CHECK(std::memcmp(bytes.data() + body + 32, mesh.colors[0].data(), 4) == 0);
}

TEST_CASE("STL: a header that no reader takes for text, then 50 bytes a triangle") {
  const Mesh mesh = build_mesh(random_tree(3, 700), {});
  std::ostringstream out;
  write_stl(mesh, kProvenance, out);
  const std::string bytes = out.str();
  CHECK(bytes.rfind("ramify 1.2.3", 0) == 0);
  REQUIRE(bytes.size() == 84 + 50 * mesh.triangles.size());
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, 4);
  CHECK(count == mesh.triangles.size());
  // The last one too: it is in a chunk that is not full.
  for (const std::size_t t : {std::size_t{0}, mesh.triangles.size() - 1}) {
    std::array<Vec3f, 4> facet;
    std::memcpy(facet.data(), bytes.data() + 84 + 50 * t, 48);
    for (std::size_t i = 0; i < 3; ++i) CHECK(facet[i + 1] == mesh.positions[mesh.triangles[t][i]]);
    CHECK(std::abs(glm::dot(facet[0], facet[2] - facet[1])) < 1e-4f);
    CHECK(glm::dot(facet[0], glm::cross(facet[2] - facet[1], facet[3] - facet[1])) > 0.0f);
  }
}
