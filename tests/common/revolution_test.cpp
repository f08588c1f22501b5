// Surfaces of revolution: sketches in configs and in files.

#include <fstream>
#include <numbers>

#include "common/base/errors.h"
#include "common/volume/volume.h"
#include "tests/catch.h"
#include "tests/common/solids.h"
#include "tests/folder.h"

using namespace ramify;
using ramify::test::Folder;
using ramify::test::problem_of;

namespace {

constexpr double kPi = std::numbers::pi;

std::string write(const Folder& folder, const std::string& text) {
  std::ofstream(folder.file("sketch.csv")) << text;
  return folder.file("sketch.csv");
}

Volume turned(Sketch points) {
  return {.shape = Shape::revolution, .points = std::move(points)};
}

Volume of_file(const std::string& file) {
  return {.shape = Shape::revolution, .file = file};
}

/// The message about a file of that text, without the folder's name.
std::string problem_of_csv(const std::string& text) {
  const Folder folder;
  const std::string problem = problem_of("crown", of_file(write(folder, text)));
  const std::size_t begin = problem.find(folder.path().string());
  if (begin == std::string::npos) return problem;
  return problem.substr(0, begin) + problem.substr(begin + folder.path().string().size() + 1);
}

}  // namespace

TEST_CASE("revolution: a point is inside where its radius and height are inside the sketch") {
  const Volume spindle{.shape = Shape::revolution, .center = {1, 0, 0}, .points = {{0, 0}, {1, 2}, {0, 4}}};
  CHECK(contains(spindle, {1, 0, 0}));
  CHECK(contains(spindle, {2, 2, 0}));
  CHECK(contains(spindle, {1, 2, -0.99}));
  CHECK_FALSE(contains(spindle, {1, 2, -1.01}));
  CHECK_FALSE(contains(spindle, {1.6, 1, 0}));
  CHECK(contains(spindle, {1.4, 1, 0}));
  CHECK(contains(spindle, {1, 4, 0}));
  CHECK_FALSE(contains(spindle, {1, 4.01, 0}));
  CHECK(std::abs(volume_of(spindle) - kPi * 4 / 3) < 0.01);
}

TEST_CASE("revolution: a sketch may go either way, overhang and leave the axis hollow") {
  const Volume up = turned({{1, 0}, {1, 2}});
  const Volume down = turned({{1, 2}, {1, 0}});
  CHECK(volume_of(up) == volume_of(down));
  // A cup: the wall from 0.8 to 1, the floor up to 0.2.
  const Volume cup = turned({{0, 0}, {1, 0}, {1, 2}, {0.8, 2}, {0.8, 0.2}, {0, 0.2}});
  CHECK(contains(cup, {0.9, 1.5, 0}));
  CHECK_FALSE(contains(cup, {0.5, 1.5, 0}));
  CHECK(contains(cup, {0.5, 0.1, 0}));
  CHECK(std::abs(volume_of(cup) - kPi * (2 - 0.64 * 1.8)) < 0.01);
}

TEST_CASE("revolution: depth is the distance to all but the flat bottom") {
  const Volume log = turned({{1, 0}, {1, 4}});
  CHECK(std::abs(outer_depth(log, {0.2, 0.01, 0}) - 0.8) < 1e-12);
  CHECK(std::abs(outer_depth(log, {0.2, 3.9, 0}) - 0.1) < 1e-12);
  CHECK(std::abs(outer_depth(log, {0, 2, 0}) - 1.0) < 1e-12);
  const Volume cone = turned({{1, 0}, {0, 1}});
  CHECK(std::abs(outer_depth(cone, {0, 0, 0}) - std::sqrt(0.5)) < 1e-12);
  CHECK(outer_depth(cone, {0, 2, 0}) == 0.0);
  Volume twice = log;
  twice.scale = {2, 2, 2};
  twice.rotate = {0, 0, 90};
  CHECK(std::abs(outer_depth(twice, {-0.02, 0.4, 0}) - 1.6) < 1e-12);
}

TEST_CASE("revolution: a file's points are those of the config, with or without its header") {
  const Folder folder;
  const Volume sketched = turned({{0, 0}, {1.5, 2}, {0, 4}});
  for (const std::string text : {"radius,height\n0,0\n1.5,2\n0,4\n", "0,0\n1.5,2\n0,4",
                                 " radius, height\r\n0,0\r\n\r\n 1.5 , 2e0\r\n0,4\r\n"}) {
    const Volume read = of_file(write(folder, text));
    CHECK(problem_of("crown", read).empty());
    CHECK(volume_of(read) == volume_of(sketched));
  }
}

TEST_CASE("revolution: what keeps a sketch from being turned is named with its point or line") {
  CHECK(problem_of("crown", turned({})) ==
        "crown.points: a revolution without a sketch (points, or a file of them)");
  CHECK(problem_of("crown", turned({{1, 2}})) == "crown.points: a sketch of 1 points (at least 2)");
  CHECK(problem_of("crown", turned({{1, 0}, {2, 1}, {-0.5, 2}})) ==
        "crown.points: point 3: radius -0.5 is less than 0");
  CHECK(problem_of("crown", turned({{0, 0}, {0, 2}})).find("crown: nothing inside it") == 0);
  CHECK(problem_of("crown", {.shape = Shape::revolution, .points = {{0, 0}, {1, 1}}, .file = "a.csv"}) ==
        "crown.file: points are given, too (either of them)");
  CHECK(problem_of("crown", of_file("no/such.csv")) ==
        "crown.file: no/such.csv: cannot read: No such file or directory");
  CHECK(problem_of_csv("") == "crown.file: sketch.csv: a sketch of 0 points (at least 2)");
  CHECK(problem_of_csv("radius,height\n0,0\n1;2\n") ==
        "crown.file: sketch.csv:3: '1;2' is no point (two numbers, radius,height)");
  CHECK(problem_of_csv("height,radius\n0,0\n1,2\n") ==
        "crown.file: sketch.csv:1: 'height,radius' is no point (two numbers, radius,height)");
  CHECK(problem_of_csv("0,0\n1,2,3\n") ==
        "crown.file: sketch.csv:2: '1,2,3' is no point (two numbers, radius,height)");
  CHECK(problem_of_csv("0,0\n1,inf\n") ==
        "crown.file: sketch.csv:2: '1,inf' is no point (two numbers, radius,height)");
  CHECK(problem_of_csv("0,0\n-1,2\n0,4\n") == "crown.file: sketch.csv: point 2: radius -1 is less than 0");
  CHECK(problem_of("crown", {.shape = Shape::union_of, .parts = {turned({{1, 2}})}}) ==
        "crown.parts.1.points: a sketch of 1 points (at least 2)");
  CHECK(problem_of("crown", {.shape = Shape::revolution, .direction = {0, 0, 0}, .points = {{1, 0}, {1, 1}}})
            .find("crown.direction: its length is 0") == 0);
}
