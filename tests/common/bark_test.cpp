// Bark: textures, their repetition, colours and tangents.

#include <algorithm>
#include <fstream>

#include "common/base/errors.h"
#include "common/base/parallel.h"
#include "common/mesh/bark_texture.h"
#include "common/mesh/tangents.h"
#include "common/mesh/tree_mesh.h"
#include "common/skeleton/passes.h"
#include "tests/catch.h"
#include "tests/common/trees.h"
#include "tests/folder.h"

using namespace ramify;
using namespace ramify::test;

namespace {

constexpr BarkKind kKinds[] = {BarkKind::ridged, BarkKind::smooth, BarkKind::plated};

/// Mean difference, over a channel, of the pixels of two columns (or rows).
double difference(const Image& image, bool is_column, int first, int second) {
  const int length = is_column ? image.height : image.width;
  double sum = 0.0;
  for (int i = 0; i < length; ++i) {
    const std::uint8_t* a = is_column ? image.pixel(first, i) : image.pixel(i, first);
    const std::uint8_t* b = is_column ? image.pixel(second, i) : image.pixel(i, second);
    for (int channel = 0; channel < 3; ++channel) sum += std::abs(a[channel] - b[channel]);
  }
  return sum / (3.0 * length);
}

/// The greatest difference of neighbouring columns (or rows) inside the image.
double steepest_step(const Image& image, bool is_column) {
  double steepest = 0.0;
  const int count = is_column ? image.width : image.height;
  for (int i = 1; i < count; ++i) steepest = std::max(steepest, difference(image, is_column, i - 1, i));
  return steepest;
}

Mesh barked(const Skeleton& skeleton, const BarkOptions& options = {}) {
  Looks looks;
  looks.bark = options;
  return make_tree_mesh(skeleton, looks, 1).mesh;
}

}  // namespace

TEST_CASE("bark: textures go on at the opposite edge as they do inside") {
  for (const BarkKind kind : kKinds) {
    const BarkTexture texture = make_bark_texture(kind, 256);
    for (const Image* image : {&texture.shade, &texture.normal_map}) {
      for (const bool is_column : {true, false}) {
        CHECK(difference(*image, is_column, 255, 0) <= steepest_step(*image, is_column));
      }
    }
  }
}

TEST_CASE("bark: textures differ by kind, are rough in their own measure and no blank") {
  std::vector<double> roughness;
  for (const BarkKind kind : kKinds) {
    const BarkTexture texture = make_bark_texture(kind, 128);
    CHECK(texture.mean_shade > 0.3);
    CHECK(texture.mean_shade < 0.9);
    double tilt = 0.0;
    for (std::size_t i = 0; i < texture.normal_map.rgba.size(); i += 4) {
      Vec3f normal;
      for (int axis = 0; axis < 3; ++axis) {
        normal[axis] =
            static_cast<float>(texture.normal_map.rgba[i + static_cast<std::size_t>(axis)]) / 127.5f - 1.0f;
      }
      CHECK(glm::length(normal) == Approx(1.0f).margin(0.02));
      tilt += 1.0 - normal.z;
    }
    roughness.push_back(tilt);
  }
  CHECK(roughness[1] > 0.0);
  CHECK(roughness[1] < 0.3 * roughness[0]);  // smooth bark
  CHECK(roughness[1] < 0.3 * roughness[2]);
}

TEST_CASE("bark: a texture is the same each time, for any number of threads") {
  const BarkTexture texture = make_bark_texture(BarkKind::ridged, 128);
  const ThreadLimit limit(1);
  CHECK(make_bark_texture(BarkKind::ridged, 128).shade.rgba == texture.shade.rgba);
  CHECK(make_bark_texture(BarkKind::ridged, 128).normal_map.rgba == texture.normal_map.rgba);
}

TEST_CASE("bark: the texture stands around a trunk as often as fits, three times at least") {
  Skeleton trunk = pole(2);
  for (double& d : trunk.diameter) d = 0.2;
  BarkOptions options;
  const auto times = [&](double tile_width) {
    options.tile_width = tile_width;
    float highest = 0.0f;
    for (const Vec2f& uv : barked(trunk, options).uvs) highest = std::max(highest, uv.x);
    return highest;
  };
  const double girth = std::numbers::pi * 0.2;
  CHECK(times(0.1) == static_cast<float>(std::round(girth / 0.1)));
  CHECK(times(10.0) == 3.0f);
}

TEST_CASE("bark: on a lateral the texture is about as wide as on the wood that bears it") {
  for (const double diameter : {0.05, 0.1, 0.2, 0.3}) {
    Skeleton tree = pole(4);
    for (double& d : tree.diameter) d = 0.3;
    const Vec3 fork = tree.position[2];
    tree.position.push_back(fork + Vec3(1, 0.5, 0));
    tree.parent.push_back(2);
    tree.diameter.push_back(diameter);
    tree.kind.push_back(Kind::stem);
    assign_axes(tree);
    BarkOptions options;
    options.tile_width = 10.0;
    const Mesh mesh = barked(tree, options);
    float trunk = 0.0f;
    float lateral = 0.0f;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      float& highest = tree.axis[mesh.internodes[v]] == tree.axis[5] ? lateral : trunk;
      highest = std::max(highest, mesh.uvs[v].x);
    }
    INFO(diameter << " m");
    CHECK(trunk == 3.0f);
    const double scale = (diameter / lateral) / (0.3 / trunk);
    CHECK(scale > 0.49);
    CHECK(scale < 1.51);
  }
}

TEST_CASE("bark: twigs have another colour than the trunk") {
  const Mesh mesh = barked(pole(10));
  REQUIRE(mesh.colors.size() == mesh.vertex_count());
  const auto color_of = [&](std::uint32_t node) {
    const auto vertex = std::find(mesh.internodes.begin(), mesh.internodes.end(), node);
    return mesh.colors[static_cast<std::size_t>(vertex - mesh.internodes.begin())];
  };
  CHECK(color_of(1) != color_of(10));
}

TEST_CASE("bark: at a fork the lateral's colour begins as its parent's, whatever the method") {
  Skeleton tree = pole(4);
  tree.position.push_back(tree.position[2] + Vec3(1.5, 0.2, 0));
  tree.parent.push_back(2);
  tree.diameter.push_back(0.02);
  tree.kind.push_back(Kind::stem);
  assign_axes(tree);
  for (const MeshMethod method : {MeshMethod::smooth, MeshMethod::cones, MeshMethod::watertight}) {
    Looks looks;
    looks.mesher.method = method;
    const Mesh mesh = make_tree_mesh(tree, looks, 1).mesh;
    const auto color_near = [&](const Vec3f& place, std::uint32_t internode) {
      std::size_t nearest = mesh.vertex_count();
      for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.internodes[v] != internode) continue;
        const bool is_nearer =
            nearest == mesh.vertex_count() ||
            glm::length(mesh.positions[v] - place) < glm::length(mesh.positions[nearest] - place);
        if (is_nearer) nearest = v;
      }
      return mesh.colors.at(nearest);
    };
    const auto step = [](const auto& a, const auto& b) {
      int greatest = 0;
      for (std::size_t i = 0; i < 3; ++i) greatest = std::max(greatest, std::abs(a[i] - b[i]));
      return greatest;
    };
    const Vec3f foot(tree.position[2] + Vec3(0.5 * tree.diameter[2], 0.0, 0.0));
    const auto trunk = color_near(foot, 2);
    const auto tip = color_near(Vec3f(tree.position[5]), 5);
    INFO(static_cast<int>(method));
    CHECK(step(trunk, tip) > 20);
    CHECK(step(trunk, color_near(foot, 5)) < 8);
  }
}

TEST_CASE("bark: tangents are unit vectors across the normal") {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Mesh mesh = barked(random_tree(seed, 60));
    REQUIRE(mesh.tangents.size() == mesh.vertex_count());  // there are no leaves
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
      CHECK(glm::length(Vec3f(mesh.tangents[i])) == Approx(1.0f).margin(1e-4));
      CHECK(glm::dot(Vec3f(mesh.tangents[i]), mesh.normals[i]) == Approx(0.0f).margin(1e-4));
    }
  }
}

TEST_CASE("bark: no texture lies mirrored on a straight stem") {
  const Mesh mesh = barked(pole(8));
  std::size_t mirrored = 0;
  for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
    const auto [a, b, c] = mesh.triangles[triangle];
    if (mesh.normals[a].y < -0.9f) continue;  // the flat end under the root
    mirrored += mesh.tangents[a].w < 0.0f;
  }
  CHECK(mesh.triangles.size() > 50);
  CHECK(mirrored == 0);
}

TEST_CASE("bark: on a flat square the tangent is u's direction and, where it is mirrored, w is -1") {
  for (const float side : {1.0f, -1.0f}) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.uvs = {{0, 0}, {side, 0}, {side, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.ranges = {{0, 0, 2}};
    mesh.materials.resize(1);
    compute_tangents(mesh);
    CHECK(mesh.tangents.empty());
    mesh.materials[0].normal_map = {1, 1, {128, 128, 255, 255}};
    compute_tangents(mesh);
    REQUIRE(mesh.tangents.size() == 4);
    for (const glm::vec4& tangent : mesh.tangents) CHECK(tangent == glm::vec4(side, 0, 0, side));
  }
}

TEST_CASE("bark: tangents are the same for any number of threads") {
  const Mesh mesh = barked(random_tree(9, 3000));
  const ThreadLimit limit(1);
  CHECK(barked(random_tree(9, 3000)).tangents == mesh.tangents);
}

TEST_CASE("bark: plain wood has neither image nor tangents") {
  BarkOptions options;
  options.kind = BarkKind::plain;
  const Mesh mesh = barked(pole(3), options);
  CHECK(mesh.materials[0].image.is_empty());
  CHECK(mesh.tangents.empty());
  CHECK(!mesh.colors.empty());
}

TEST_CASE("bark: an image of one's own is used as it is, uncoloured") {
  const Folder folder;
  const Image image{2, 1, {10, 20, 30, 255, 200, 100, 50, 255}};
  std::ofstream(folder.file("bark.png"), std::ios::binary) << png_bytes(image);
  BarkOptions options;
  options.image = folder.file("bark.png");
  const Mesh mesh = barked(pole(3), options);
  CHECK(mesh.materials[0].image.rgba == image.rgba);
  CHECK(mesh.materials[0].normal_map.is_empty());
  CHECK(mesh.colors.empty());
}
