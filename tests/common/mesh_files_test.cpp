// glTF, OBJ and PLY files.

#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/base/errors.h"
#include "common/mesh/gltf.h"
#include "common/mesh/mesher.h"
#include "common/mesh/obj.h"
#include "common/mesh/ply.h"
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
