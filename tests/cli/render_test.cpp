#include <algorithm>
#include <fstream>

#include "common/base/files.h"
#include "tests/catch.h"
#include "tests/cli/program.h"
#include "tests/folder.h"

using namespace ramify;
using namespace ramify::test;

namespace {

std::pair<std::uint32_t, std::uint32_t> png_size(const std::string& path) {
  const std::string bytes = read_file(path);
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
    return value;
  };
  return {number(16), number(20)};
}

}  // namespace

TEST_CASE("render: presets, tables and meshes become pictures of the size asked for") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("generate s4-fig6 -o a.csv -o a.glb -o a.gltf", where).code == 0);
  for (const std::string input : {"s4-fig6", "a.csv", "a.glb", "a.gltf"}) {
    const Outcome outcome = run_program("render " + input + " -o p.png --size 96x64", where);
    INFO(input << ": " << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(png_size(folder.file("p.png")) == std::pair(96u, 64u));
  }
}

TEST_CASE("render: several inputs stand side by side") {
  const Folder folder;
  const Outcome outcome =
      run_program("render s4-fig6 xm12-fig5 -o p.png --size 64x64", folder.path().string());
  CHECK(outcome.code == 0);
  CHECK(png_size(folder.file("p.png")) == std::pair(128u, 64u));
}

TEST_CASE("render: --columns begins a new row") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("render s4-fig3 s4-fig4 s4-fig5 -o p.png --size 64x32 --columns 2", where).code == 0);
  CHECK(png_size(folder.file("p.png")) == std::pair(128u, 64u));
  const Outcome none = run_program("render s4-fig3 -o p.png --columns 0", where);
  CHECK(none.code == 2);
  CHECK(none.err.find("--columns") != std::string::npos);
}

TEST_CASE("render: a table shows the same picture as the preset that made it") {
  const Folder folder;
  const std::string where = folder.path().string();
  // With one internode at the root: a table does not carry the width of the root node itself.
  const std::string preset = "p09-fig7-50 --steps 10 ";
  REQUIRE(run_program("generate " + preset + "-o a.csv", where).code == 0);
  REQUIRE(run_program("render a.csv -o a.png --size 200x200", where).code == 0);
  REQUIRE(run_program("render " + preset + "-o b.png --size 200x200", where).code == 0);
  CHECK(read_file(folder.file("a.png")) == read_file(folder.file("b.png")));
}

TEST_CASE("render: every style, view, colour, scale and background makes a picture of its own") {
  const Folder folder;
  const std::string where = folder.path().string();
  std::vector<std::string> seen;
  for (const std::string flags : {"",
                                  "--style schematic",
                                  "--style skeleton",
                                  "--view side",
                                  "--view top",
                                  "--view 30,15",
                                  "--color-by order",
                                  "--color-by birthStep",
                                  "--color-by light",
                                  "--color-by vigour",
                                  "--color-by strahler",
                                  "--color-by width",
                                  "--scale",
                                  "--background '#ff8800'",
                                  "--background transparent",
                                  "--at-step 5",
                                  "--look-at 0,0.5,0",
                                  "--look-at 0,0.5,0 --across 0.2",
                                  "--look-at 0,0.6,0 --across 0.2",
                                  "--look-at 0,0.6,0 --style schematic"}) {
    const Outcome outcome = run_program("render s4-fig7 -o p.png --size 128x128 " + flags, where);
    INFO(flags << ": " << outcome.err);
    REQUIRE(outcome.code == 0);
    const std::string bytes = read_file(folder.file("p.png"));
    CHECK(std::find(seen.begin(), seen.end(), bytes) == seen.end());
    seen.push_back(bytes);
  }
}

TEST_CASE("render: no display is needed") {
  const Folder folder;
  CHECK(run_program("render s4-fig3 -o p.png --size 64x64", folder.path().string(),
                    "env -u DISPLAY -u WAYLAND_DISPLAY ")
            .code == 0);
}

TEST_CASE("render: where there is no OpenGL one line says what to install, and the exit code is 1") {
  const Folder folder;
  const Outcome outcome = run_program("render s4-fig3 -o p.png", folder.path().string(),
                                      "env __EGL_VENDOR_LIBRARY_FILENAMES=/dev/null ");
  CHECK(outcome.code == 1);
  CHECK(outcome.err.rfind("ramify: no OpenGL 3.3 to draw with: ", 0) == 0);
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(folder.count() == 0);
}

TEST_CASE("render: a mesh that ramify made is a config for flags that change its tree") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("generate s4-fig6 -o a.glb", where).code == 0);
  REQUIRE(run_program("render a.glb --seed 3 --at-step 4 -o a.png --size 128x128", where).code == 0);
  REQUIRE(run_program("render s4-fig6 --seed 3 --at-step 4 -o b.png --size 128x128", where).code == 0);
  CHECK(read_file(folder.file("a.png")) == read_file(folder.file("b.png")));
}

TEST_CASE("render: what cannot be drawn is one line and leaves no file") {
  const Folder folder;
  const std::string where = folder.path().string();
  REQUIRE(run_program("generate s4-fig6 -o a.csv -o a.glb", where).code == 0);
  std::ofstream(folder.file("b.gltf")) << "{\"asset\": {\"version\": \"2.0\"}}";
  struct Case {
    std::string arguments;
    int code;
    std::string message;
  };
  const std::vector<Case> cases = {
      {"s4-fig6 -o p.jpg", 2, "p.jpg: a picture ends in .png"},
      {"s4-fig6 -o p.png --size 10x10", 2, "--size: '10x10' is no WxH (16x16 to 16384x16384)"},
      {"s4-fig6 -o p.png --size 100", 2, "--size: '100' is no WxH (16x16 to 16384x16384)"},
      {"s4-fig6 -o p.png --view up", 2, "--view: 'up' (front | side | top | AZ,EL in degrees)"},
      {"s4-fig6 -o p.png --style watercolour", 2, "--style: 'watercolour' (lit | schematic | skeleton)"},
      {"s4-fig6 -o p.png --background nocolour", 2,
       "--background: 'nocolour' (#rrggbb, a colour's name or transparent)"},
      {"s4-fig6 -o no/p.png", 1, "no/p.png: cannot write: there is no folder no"},
      {"a.csv -o p.png --seed 3", 2, "--seed: a.csv goes with configs only"},
      {"s4-fig6 -o p.png --look-at 1,2", 2, "--look-at: '1,2' (X,Y,Z in metres)"},
      {"s4-fig6 -o p.png --look-at 1,2,nan", 2, "--look-at: '1,2,nan' (X,Y,Z in metres)"},
      {"s4-fig6 -o p.png --across 2", 2, "--across: goes with --look-at"},
      {"b.gltf -o p.png --seed 3", 2,
       "b.gltf: no config of ramify inside (files that `ramify generate` wrote have one)"},
      {"none.csv -o p.png", 2, "none.csv: cannot read: No such file or directory"},
      {"xm12-fig5 -o p.png --at-step 1", 2, "--at-step: xm12-fig5 has no steps"},
  };
  for (const Case& c : cases) {
    const Outcome outcome = run_program("render " + c.arguments, where);
    CHECK(outcome.code == c.code);
    CHECK(outcome.err == "ramify: " + c.message + "\n");
    CHECK(folder.count() == 3);
  }
  for (const std::string flags : {"--color-by level", "--color-by nothing"}) {
    const Outcome outcome = run_program("render s4-fig6 -o p.png " + flags, where);
    CHECK(outcome.code == 2);
    CHECK(outcome.err.rfind("ramify: ", 0) == 0);
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(folder.count() == 3);
  }
}
