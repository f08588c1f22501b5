// Leaves and bark through the program.

#include <algorithm>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/base/files.h"
#include "common/base/image.h"
#include "tests/catch.h"
#include "tests/cli/program.h"
#include "tests/folder.h"

using namespace ramify;
using namespace ramify::test;

namespace {

nlohmann::json json_of_glb(const std::string& path) {
  const std::string glb = read_file(path);
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  return nlohmann::json::parse(glb.substr(20, length));
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

TEST_CASE("dress: a leafy tree's GLB has both materials, and the summary tells of its leaves") {
  const Folder folder;
  const std::string run = "generate s4-fig6 --set leaves.shape=lobed -o a.glb";
  const auto json = nlohmann::json::parse(run_program(run + " --json --quiet", folder.path().string()).out);
  CHECK(json["leaves"]["count"].get<int>() > 50);
  CHECK(json["leaves"]["area"].get<double>() > 0.01);
  const nlohmann::json glb = json_of_glb(folder.file("a.glb"));
  CHECK(glb["materials"][0]["name"] == "bark");
  CHECK(glb["materials"][1]["name"] == "leaf");
  CHECK(glb["materials"][1]["alphaMode"] == "MASK");
  const std::string summary = run_program(run, folder.path().string()).out;
  CHECK(summary.find(" leaves, ") != std::string::npos);
  CHECK(nlohmann::json::parse(
            run_program("generate s4-fig6 -o a.glb --json", folder.path().string()).out)["leaves"]
            .is_null());
}

TEST_CASE("dress: leaves change no skeleton") {
  const Folder folder;
  run_program("generate s4-fig6 -o a.csv --quiet", folder.path().string());
  run_program("generate s4-fig6 --set leaves.shape=ovate -o b.csv -o b.glb --quiet", folder.path().string());
  CHECK(read_file(folder.file("a.csv")) == read_file(folder.file("b.csv")));
}

TEST_CASE("dress: images and leaves of one's own are looked for beside the config") {
  const Folder folder;
  std::filesystem::create_directory(folder.file("own"));
  write_bytes(folder.file("own/bark.png"), png_bytes({1, 1, {90, 60, 30, 255}}));
  write_bytes(folder.file("own/leaf.obj"), "v -1 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
  write_bytes(folder.file("own/oak.toml"),
              "base = \"s4-fig6\"\n[bark]\nimage = \"bark.png\"\n[leaves]\nmesh = \"leaf.obj\"\n");
  const Outcome outcome = run_program("generate own/oak.toml -o a.glb --quiet", folder.path().string());
  CHECK(outcome.code == 0);
  const nlohmann::json glb = json_of_glb(folder.file("a.glb"));
  CHECK(glb["images"].size() == 1);
  CHECK(glb["meshes"][0]["primitives"].size() == 3);  // bark, leaves and bark over forks
}

TEST_CASE("dress: the example with a leaf of one's own works from its file") {
  const std::string config = std::string(RAMIFY_SOURCE_DIR) + "/docs/own-leaf/ash.toml";
  const Folder folder;
  const Outcome outcome =
      run_program("generate " + config + " --steps 12 -o a.glb --json --quiet", folder.path().string());
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  const auto json = nlohmann::json::parse(outcome.out);
  CHECK(json["leaves"]["count"].get<int>() > 10);
  const nlohmann::json glb = json_of_glb(folder.file("a.glb"));
  REQUIRE(glb["materials"].size() == 4);  // bark, the midribs, the leaflets and bark over forks
  CHECK(glb["materials"][2]["name"] == "leaf-2");
}

TEST_CASE("dress: what cannot be used is one line with file, line and key, exit code 2 and no file") {
  const Folder folder;
  const std::string png = png_bytes({64, 64, std::vector<std::uint8_t>(4 * 64 * 64, 99)});
  std::string lying = png;
  lying.replace(16, 8, std::string("\0\0\x1f\xff\0\0\x1f\xff", 8));
  write_bytes(folder.file("half.png"), png.substr(0, png.size() / 2));
  write_bytes(folder.file("lying.png"), lying);
  write_bytes(folder.file("text.png"), "no image");
  write_bytes(folder.file("cut.glb"), "glTF\2");
  struct Case {
    std::string text;
    std::string message;
  };
  const std::vector<Case> cases = {
      {"[bark]\nimage = \"none.png\"\n",
       "a.toml:3: bark.image: none.png: cannot read: No such file or directory\n"},
      {"[bark]\nimage = \"half.png\"\n", "a.toml:3: bark.image: half.png: damaged image: "},
      {"[bark]\nimage = \"lying.png\"\n", "a.toml:3: bark.image: lying.png: claims 8191 x 8191 pixels in "},
      {"[bark]\nimage = \"text.png\"\n", "a.toml:3: bark.image: text.png: no PNG or JPEG image: "},
      {"[bark]\nnormal = \"a.toml\"\n", "a.toml:3: bark.normal: a.toml: no PNG or JPEG image: "},
      {"[bark]\nkind = \"oak\"\n",
       "a.toml:3: bark.kind: 'oak' is not known (plain | ridged | smooth | plated)\n"},
      {"[leaves]\nmesh = \"none.glb\"\n",
       "a.toml:3: leaves.mesh: none.glb: cannot read: No such file or directory\n"},
      {"[leaves]\nmesh = \"cut.glb\"\n", "a.toml:3: leaves.mesh: cut.glb: no glTF: "},
      {"[leaves]\nshape = \"heart\"\n",
       "a.toml:3: leaves.shape: 'heart' is not known (none | ovate | lanceolate | lobed | needles)\n"},
      {"[leaves]\nspacing = 0\n", "a.toml:3: leaves.spacing: 0 is out of range (a number, 0.0001 to 100)\n"},
  };
  for (const Case& c : cases) {
    write_bytes(folder.file("a.toml"), "base = \"s4-fig6\"\n" + c.text);
    const Outcome outcome = run_program("generate a.toml -o a.glb", folder.path().string());
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.err.rfind("ramify: " + c.message, 0) == 0);
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(!std::filesystem::exists(folder.file("a.glb")));
  }
}

TEST_CASE("dress: leaves by age need a tree with steps") {
  const Folder folder;
  const Outcome outcome =
      run_program("generate xm12-fig5 --set leaves.shape=ovate --set leaves.max_age=2 -o a.glb --quiet",
                  folder.path().string());
  CHECK(outcome.code == 2);
  CHECK(outcome.err == "ramify: leaves.max_age: the tree has no steps (0: wood of any age)\n");
  CHECK(folder.count() == 0);
}

TEST_CASE("dress: a GLB's picture is the picture of the tree it holds") {
  const Folder folder;
  const std::string where = folder.path().string();
  const std::string looks = "s4-fig6 --set leaves.shape=lobed --set leaves.length=0.3 --quiet ";
  REQUIRE(run_program("generate " + looks + "-o a.glb", where).code == 0);
  REQUIRE(run_program("render " + looks + "-o a.png --size 128x128", where).code == 0);
  REQUIRE(run_program("render a.glb -o b.png --size 128x128 --quiet", where).code == 0);
  const Image a = decoded_image(read_file(folder.file("a.png")), "a");
  const Image b = decoded_image(read_file(folder.file("b.png")), "b");
  double difference = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) difference += std::abs(a.rgba[i] - b.rgba[i]);
  CHECK(difference / static_cast<double>(a.rgba.size()) < 1.0);
  const bool has_green = [&] {
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
      if (a.rgba[i + 1] > a.rgba[i] + 20 && a.rgba[i + 1] > a.rgba[i + 2] + 20) return true;
    }
    return false;
  }();
  CHECK(has_green);
}
