// Closed meshes from files as volumes.

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <numbers>
#include <sstream>

#include "common/base/errors.h"
#include "common/base/parallel.h"
#include "common/volume/volume.h"
#include "tests/catch.h"
#include "tests/common/solids.h"
#include "tests/folder.h"

using namespace ramify;
using ramify::test::check_meets;
using ramify::test::Folder;
using ramify::test::points_around;
using ramify::test::problem_of;

namespace {

constexpr double kPi = std::numbers::pi;

constexpr const char* kCubePoints =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
constexpr const char* kCubeFaces = "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

std::string write(const Folder& folder, const std::string& text) {
  std::ofstream(folder.file("rock.obj")) << text;
  return folder.file("rock.obj");
}

/// A ball of radius 1 about the origin as a mesh of `rings` rings, every number with the corners from
/// `first`.
std::string ball_text(int rings, double radius = 1.0, int first = 1) {
  std::ostringstream text;
  text.precision(9);
  const int around = 2 * rings;
  text << "v 0 " << radius << " 0\n";
  for (int i = 1; i < rings; ++i) {
    for (int j = 0; j < around; ++j) {
      const double polar = kPi * i / rings;
      const double azimuth = 2 * kPi * j / around;
      text << "v " << radius * std::sin(polar) * std::cos(azimuth) << ' ' << radius * std::cos(polar) << ' '
           << radius * std::sin(polar) * std::sin(azimuth) << '\n';
    }
  }
  text << "v 0 " << -radius << " 0\n";
  const auto corner = [&](int i, int j) {
    if (i == 0) return first;
    if (i == rings) return first + 1 + (rings - 1) * around;
    return first + 1 + (i - 1) * around + j % around;
  };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < around; ++j) {
      text << "f " << corner(i, j);
      if (i > 0) text << ' ' << corner(i, j + 1);
      if (i < rings - 1) text << ' ' << corner(i + 1, j + 1);
      text << ' ' << corner(i + 1, j);
      text << '\n';
    }
  }
  return text.str();
}

Volume of_file(const std::string& file) {
  return {.shape = Shape::mesh, .file = file};
}

/// The message about a file of that text, without the folder's name.
std::string problem_of_obj(const std::string& text, double voxel_size = 0.0) {
  const Folder folder;
  Volume volume = of_file(write(folder, text));
  volume.voxel_size = voxel_size;
  const std::string problem = problem_of("rock", volume);
  const std::size_t begin = problem.find(folder.path().string());
  if (begin == std::string::npos) return problem;
  return problem.substr(0, begin) + problem.substr(begin + folder.path().string().size() + 1);
}

/// No point farther than `near` from the surface of `known` is on another side of the mesh.
void check_same(const Volume& mesh, const Volume& known, double near) {
  const Solid a(mesh);
  const Solid b(known);
  int inside_count = 0;
  for (const Vec3& point : points_around(known, 50'000)) {
    if (b.is_farther(point, near)) REQUIRE_FALSE(a.contains(point));
    if (b.contains(point) && b.outer_depth(point) > near) REQUIRE(a.contains(point));
    inside_count += a.contains(point);
  }
  CHECK(inside_count > 1000);
}

}  // namespace

TEST_CASE("mesh volume: a cube's inside is that of a box, within a voxel") {
  const Folder folder;
  const Volume cube = of_file(write(folder, std::string(kCubePoints) + kCubeFaces));
  const Volume box{.shape = Shape::box, .center = {0.5, 0.5, 0.5}};
  CHECK(problem_of("rock", cube).empty());
  check_same(cube, box, 1.0 / 128);
  CHECK(std::abs(volume_of(cube) - 1.0) < 0.005);
  CHECK(bounds(cube).low == Vec3(0, 0, 0));
  CHECK(bounds(cube).high == Vec3(1, 1, 1));
}

TEST_CASE("mesh volume: a ball's inside and depth are those of a sphere, within its facets") {
  const Folder folder;
  const Volume mesh = of_file(write(folder, ball_text(60)));
  const Volume sphere{.shape = Shape::sphere};
  check_same(mesh, sphere, 0.003);
  CHECK(std::abs(volume_of(mesh) - 4.0 / 3 * kPi) < 0.015);
  const Solid solid(mesh);
  for (const Vec3& point : points_around(sphere, 2000)) {
    const double depth = 1.0 - glm::length(point);
    if (depth > 0.01) CHECK(std::abs(solid.outer_depth(point) - depth) < 0.05);
    if (depth > 0.01 && depth < 0.03) CHECK(std::abs(solid.outer_depth(point) - depth) < 0.004);
    if (depth < -0.01) CHECK(solid.outer_depth(point) == 0.0);
  }
}

TEST_CASE("mesh volume: a mesh may be scaled, turned, moved, cut and united as any other shape") {
  const Folder folder;
  Volume rock = of_file(write(folder, std::string(kCubePoints) + kCubeFaces));
  rock.scale = {2, 1, 3};
  rock.rotate = {0, 0, 90};
  rock.translate = {5, 0, 0};
  const Volume box{.shape = Shape::box, .center = {4.5, 1, 1.5}, .size = {1, 2, 3}};
  check_same(rock, box, 3.0 / 128);
  const Volume ball{.shape = Shape::sphere, .center = {4.5, 1, 1.5}, .radius = 0.4};
  CHECK(std::abs(volume_of({.shape = Shape::difference, .parts = {rock, ball}}) -
                 (6 - 4.0 / 3 * kPi * 0.064)) < 0.04);
  CHECK(volume_of({.shape = Shape::difference, .parts = {ball, rock}}) == 0.0);
  CHECK_FALSE(Solid(rock).convex_part({4.5, 1, 1.5}).has_value());
}

TEST_CASE("mesh volume: a segment meets a mesh where a row of points does, within a voxel") {
  const Folder folder;
  Volume ball = of_file(write(folder, ball_text(20)));
  ball.voxel_size = 0.05;
  check_meets(ball, 0.04);
  ball.scale = {1, 2, 0.5};
  ball.rotate = {20, 0, 30};
  check_meets(ball, 0.04);
  check_meets({.shape = Shape::difference, .parts = {ball, {.shape = Shape::box}}}, 0.04);
  check_meets({.shape = Shape::difference, .parts = {{.shape = Shape::box, .size = {3, 3, 3}}, ball}}, 0.04);
}

TEST_CASE("mesh volume: a wall that is thinner than a voxel is not jumped") {
  const Folder folder;
  Volume sheet = of_file(write(folder, std::string(kCubePoints) + kCubeFaces));
  sheet.scale = {1, 1, 0.001};
  CHECK(Solid(sheet).meets({0.3, 0.3, -1}, {0.4, 0.4, 1}));
  CHECK_FALSE(Solid(sheet).meets({0.3, 0.3, 0.1}, {0.4, 0.4, 1}));
  // In the mesh itself, with voxels much too large.
  std::string text = std::string(kCubePoints) + kCubeFaces;
  for (std::size_t at; (at = text.find(" 1\nv")) != std::string::npos;) text.replace(at, 2, " 0.01");
  text.replace(text.find("v 0 1 1"), 7, "v 0 1 0.01");
  Volume thin = of_file(write(folder, text));
  thin.voxel_size = 0.1;
  for (const double x : {0.1, 0.33, 0.5, 0.77}) {
    CHECK(Solid(thin).meets({x, 0.3, -1}, {x, 0.4, 1}));
    CHECK_FALSE(Solid(thin).meets({x, 0.3, -1}, {x, 0.4, -0.2}));
  }
  // Left to itself the size is chosen so that the wall is there.
  thin.voxel_size = 0.0;
  CHECK(problem_of("rock", thin).empty());
  CHECK(std::abs(volume_of(thin) - 0.01) < 0.0005);
}

TEST_CASE("mesh volume: which way the faces look and whether they share corners does not matter") {
  const Folder folder;
  const Volume turned_inside_out =
      of_file(write(folder, std::string(kCubePoints) +
                                "f 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n"));
  CHECK(contains(turned_inside_out, {0.5, 0.5, 0.5}));
  CHECK_FALSE(contains(turned_inside_out, {1.5, 0.5, 0.5}));

  const Folder other;
  std::string split;
  const std::vector<std::string> corners = {"0 0 0", "1 0 0", "0 1 0", "0 0 1"};
  int next = 1;
  for (const auto& face :
       {std::array{0, 1, 2}, std::array{0, 1, 3}, std::array{1, 2, 3}, std::array{0, 2, 3}}) {
    for (const int corner : face) split += "v " + corners[static_cast<std::size_t>(corner)] + "\n";
    split += fmt::format("f {}/1/1 -2 {}//1\n", next, next + 2);
    next += 3;
  }
  const Volume tetrahedron =
      of_file(write(other, "# exported\nmtllib x.mtl\no thing\ns off\nvt 0 0\nvn 0 1 0\n" + split));
  CHECK(problem_of("rock", tetrahedron).empty());
  CHECK(std::abs(volume_of(tetrahedron) - 1.0 / 6) < 0.003);
}

TEST_CASE("mesh volume: bodies beside each other are all inside, a closed hollow is filled") {
  const Folder folder;
  const std::string cube = std::string(kCubePoints) + kCubeFaces;
  const std::string moved = "v 3 0 0\nv 4 0 0\nv 4 1 0\nv 3 1 0\nv 3 0 1\nv 4 0 1\nv 4 1 1\nv 3 1 1\n";
  const Volume two =
      of_file(write(folder, cube + moved +
                                "o second\nf -5 -6 -7 -8\nf -4 -3 -2 -1\nf -8 -7 -3 -4\nf -7 -6 -2 -3\n"
                                "f -6 -5 -1 -2\nf -5 -8 -4 -1\n"));
  CHECK(contains(two, {0.5, 0.5, 0.5}));
  CHECK(contains(two, {3.5, 0.5, 0.5}));
  CHECK_FALSE(contains(two, {2, 0.5, 0.5}));

  const Folder other;
  const int corners = 2 + 19 * 40;
  const Volume hollow = of_file(write(other, ball_text(20) + ball_text(20, 0.5, 1 + corners)));
  CHECK(contains(hollow, {0.8, 0, 0}));
  CHECK(contains(hollow, {0, 0, 0}));
}

TEST_CASE("mesh volume: the same for any number of threads, and a file that changed is read again") {
  const Folder folder;
  std::vector<double> depths;
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    Volume ball = of_file(write(folder, ball_text(30)));
    ball.voxel_size = 0.0301 - 1e-9 * threads;  // or it would be the one that is kept
    const Solid solid(ball);
    for (const Vec3& point : points_around({.shape = Shape::sphere}, 500))
      depths.push_back(solid.outer_depth(point));
  }
  for (std::size_t i = 0; i < 500; ++i) CHECK(std::abs(depths[i] - depths[i + 500]) < 1e-6);

  const Volume rock = of_file(folder.file("rock.obj"));
  CHECK(contains(rock, {-0.5, 0, 0}));
  write(folder, std::string(kCubePoints) + kCubeFaces);
  CHECK_FALSE(contains(rock, {-0.5, 0, 0}));
}

TEST_CASE("mesh volume: a file that is no closed mesh is named with what is wrong") {
  CHECK(problem_of("rock", {.shape = Shape::mesh}) ==
        "rock.file: a mesh without a file (a closed mesh, OBJ)");
  CHECK(problem_of("rock", of_file("no/such.obj")) ==
        "rock.file: no/such.obj: cannot read: No such file or directory");
  CHECK(problem_of("rock", of_file("/")) == "rock.file: /: is a folder, not a file");
  const std::string points = kCubePoints;
  CHECK(problem_of_obj("") == "rock.file: rock.obj: no faces (a closed mesh)");
  CHECK(problem_of_obj(points) == "rock.file: rock.obj: no faces (a closed mesh)");
  CHECK(problem_of_obj(points + "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n") ==
        "rock.file: rock.obj: not closed: 4 of 17 edges lack a triangle, one is from (0, 0, 0) to (0, 1, 0)");
  CHECK(problem_of_obj(points + "f 1 2 9\n") == "rock.file: rock.obj: a face has corner 9 of 8 points");
  CHECK(problem_of_obj(points + "f 1 2 0\n").find("rock.file: rock.obj: no OBJ: ") == 0);
  CHECK(problem_of_obj(points + kCubeFaces, 0.0001) ==
        "rock.file: rock.obj: 1 m long, more than 1000 voxels of 0.0001 m (larger voxels)");
  CHECK(problem_of("rock", {.shape = Shape::union_of, .parts = {{.shape = Shape::mesh}}}) ==
        "rock.parts.1.file: a mesh without a file (a closed mesh, OBJ)");
}
