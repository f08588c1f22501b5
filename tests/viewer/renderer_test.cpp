// Small pictures of a straight trunk, measured. They need EGL and an OpenGL driver, as the program does.

#include "viewer/renderer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/base/errors.h"
#include "tests/catch.h"
#include "tests/viewer/poles.h"

using namespace ramify;
using namespace ramify::test;

namespace {

struct Tree {
  Skeleton skeleton;
  Mesh mesh;

  explicit Tree(Skeleton of) : skeleton(std::move(of)), mesh(tube_mesh(skeleton)) {}
  Scene scene() const { return {&mesh, &skeleton}; }
};

RenderOptions small(RenderStyle style) {
  RenderOptions options;
  options.width = 100;
  options.height = 100;
  options.style = style;
  return options;
}

int brightness(const Image& image, int x, int y) {
  const std::uint8_t* pixel = image.pixel(x, y);
  return pixel[0] + pixel[1] + pixel[2];
}

bool is_white(const Image& image, int x, int y) {
  return brightness(image, x, y) == 3 * 255;
}

/// The pixels that differ from white: left, right (beyond), top and bottom (beyond).
struct Extent {
  int left = 1 << 20;
  int right = -1;
  int top = 1 << 20;
  int bottom = -1;
};

Extent drawn_extent(const Image& image) {
  Extent extent;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (is_white(image, x, y)) continue;
      extent.left = std::min(extent.left, x);
      extent.right = std::max(extent.right, x + 1);
      extent.top = std::min(extent.top, y);
      extent.bottom = std::max(extent.bottom, y + 1);
    }
  }
  return extent;
}

template <class Error>
std::string message(const Scene& scene, const RenderOptions& options) {
  Renderer renderer;
  try {
    renderer.render(scene, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("renderer: it tells who draws") {
  CHECK_FALSE(Renderer().device().empty());
}

TEST_CASE("schematic: a trunk is a black bar in the middle, with its own proportions, on white") {
  const Tree tree(pole_of(3, 4.0, 0.8));
  Renderer renderer;
  for (const char* view : {"front", "side", "37,0"}) {
    RenderOptions options = small(RenderStyle::schematic);
    options.view = *parse_view(view);
    const Image image = renderer.render(tree.scene(), options);
    REQUIRE(image.rgba.size() == 4u * 100u * 100u);
    // 4 m fill the 90 pixels within the margins: 0.8 m are 18.
    const Extent extent = drawn_extent(image);
    CHECK(std::abs(extent.left - 41) <= 1);
    CHECK(std::abs(extent.right - 59) <= 1);
    CHECK(std::abs(extent.top - 5) <= 1);
    CHECK(std::abs(extent.bottom - 95) <= 1);
    CHECK(brightness(image, 50, 50) == 0);
    CHECK(is_white(image, 0, 0));
    CHECK(is_white(image, 38, 50));
    CHECK(image.pixel(0, 0)[3] == 255);
  }
}

TEST_CASE("schematic: an edge half way across a pixel is grey, in linear light") {
  // 10 m fill 90 pixels: the bar's edges fall at 50 +- 4.5 pixels.
  const Tree tree(pole_of(1, 10.0, 1.0));
  const Image image = Renderer().render(tree.scene(), small(RenderStyle::schematic));
  CHECK(brightness(image, 46, 50) == 0);
  CHECK(std::abs(image.pixel(45, 50)[0] - 188) <= 12);
  CHECK(is_white(image, 44, 50));
}

TEST_CASE("schematic: a twig a quarter of a pixel wide does not break up") {
  Skeleton twig = pole_of(1, 10.0, 0.03);
  twig.position[1].x = 4.0;
  const Tree tree(twig);
  const Image image = Renderer().render(tree.scene(), small(RenderStyle::schematic));
  const Extent extent = drawn_extent(image);
  for (int y = extent.top + 1; y + 1 < extent.bottom; ++y) {
    int darkest = 3 * 255;
    for (int x = 0; x < image.width; ++x) darkest = std::min(darkest, brightness(image, x, y));
    INFO(y);
    CHECK(darkest < 3 * 250);
  }
}

TEST_CASE("schematic: a picture of many parts has no seams") {
  const Tree tree(pole_of(1, 1.0, 0.9));
  RenderOptions options = small(RenderStyle::schematic);
  options.width = 1100;
  options.height = 40;
  const Image image = Renderer().render(tree.scene(), options);
  const Extent extent = drawn_extent(image);
  CHECK(std::abs(extent.left + extent.right - 1100) <= 1);
  for (int x = extent.left + 1; x + 1 < extent.right; ++x) CHECK(brightness(image, x, 20) == 0);
}

TEST_CASE("lit: the shadow lies on the far side of the sun and leaves the near side bright") {
  const Tree tree(pole_of(1, 4.0, 0.8));
  RenderOptions options = small(RenderStyle::lit);
  options.view = *parse_view("0,50");
  const Image image = Renderer().render(tree.scene(), options);
  // The sun stands to the left, behind the viewer: the shadow runs to the right and away from the foot.
  int darkest_left = 3 * 255;
  int darkest_right = 3 * 255;
  for (int y = 50; y < 95; ++y) {
    for (int x = 2; x < 30; ++x) darkest_left = std::min(darkest_left, brightness(image, x, y));
    for (int x = 70; x < 98; ++x) darkest_right = std::min(darkest_right, brightness(image, x, y));
  }
  CHECK(darkest_right < darkest_left - 90);
  CHECK(darkest_left > 3 * 200);
}

TEST_CASE("lit: the side of the trunk towards the sun is the brighter one") {
  const Tree tree(pole_of(1, 4.0, 1.0));
  const Image image = Renderer().render(tree.scene(), small(RenderStyle::lit));
  CHECK(brightness(image, 45, 50) > brightness(image, 56, 50) + 40);
}

TEST_CASE("lit: from below the ground does not hide the tree") {
  const Tree tree(pole_of(1, 4.0, 0.8));
  RenderOptions options = small(RenderStyle::lit);
  options.view = *parse_view("0,-60");
  const Image image = Renderer().render(tree.scene(), options);
  CHECK(brightness(image, 50, 50) < 3 * 150);
}

TEST_CASE("lit: a background colour comes out as it is, and the ground takes it on") {
  const Tree tree(pole_of(1, 4.0, 0.4));
  RenderOptions options = small(RenderStyle::lit);
  options.background = color_of(0x336699);
  const Image image = Renderer().render(tree.scene(), options);
  for (int corner : {0, 99}) {
    const std::uint8_t* pixel = image.pixel(corner, 0);
    CHECK(pixel[0] == 0x33);
    CHECK(pixel[1] == 0x66);
    CHECK(pixel[2] == 0x99);
    CHECK(pixel[3] == 255);
  }
  CHECK(std::abs(brightness(image, 2, 97) - (0x33 + 0x66 + 0x99)) <= 6);
}

TEST_CASE("background: transparent leaves alpha 0 around the tree and 255 on it, in every style") {
  const Tree tree(pole_of(1, 4.0, 0.8));
  Renderer renderer;
  for (RenderStyle style : {RenderStyle::lit, RenderStyle::schematic, RenderStyle::skeleton}) {
    RenderOptions options = small(style);
    options.background = parse_color("transparent");
    const Image image = renderer.render(tree.scene(), options);
    for (int x : {0, 99}) {
      for (int y : {0, 99}) {
        CHECK(image.pixel(x, y)[3] == 0);
        CHECK(brightness(image, x, y) == 0);
      }
    }
    if (style != RenderStyle::skeleton) CHECK(image.pixel(50, 50)[3] == 255);
    CHECK(std::max(image.pixel(50, 50)[3], image.pixel(49, 50)[3]) > 100);
  }
}

TEST_CASE("background: a half transparent colour keeps its alpha") {
  const Tree tree(pole_of(1, 4.0, 0.8));
  RenderOptions options = small(RenderStyle::schematic);
  options.background = parse_color("#20406080");
  const Image image = Renderer().render(tree.scene(), options);
  const std::uint8_t* pixel = image.pixel(3, 3);
  CHECK(std::abs(pixel[0] - 0x20) <= 1);
  CHECK(std::abs(pixel[2] - 0x60) <= 1);
  CHECK(pixel[3] == 0x80);
}

TEST_CASE("skeleton: an internode is a line about one and a half pixels wide, from base to tip") {
  const Tree tree(pole_of(4, 4.0, 0.8));
  const Image image = Renderer().render(tree.scene(), small(RenderStyle::skeleton));
  const Extent extent = drawn_extent(image);
  CHECK(extent.right - extent.left == 2);
  CHECK(std::abs(extent.top - 5) <= 1);
  CHECK(std::abs(extent.bottom - 95) <= 1);
  CHECK(std::abs(extent.left - 49) <= 1);
}

TEST_CASE("colour by attribute: each internode has its own") {
  Tree tree(pole_of(2, 4.0, 1.0));
  tree.skeleton.order = {0, 0, 1};
  Renderer renderer;
  for (RenderStyle style : {RenderStyle::schematic, RenderStyle::lit}) {
    RenderOptions options = small(style);
    options.color_by = "order";
    const Image image = renderer.render(tree.scene(), options);
    // Order 0 is indigo, order 1 rose.
    CHECK(image.pixel(50, 75)[2] > image.pixel(50, 75)[0]);
    CHECK(image.pixel(50, 25)[0] > image.pixel(50, 25)[2]);
  }
}

TEST_CASE("colour by attribute: an unknown one and a mesh without a skeleton are errors") {
  const Tree tree(pole_of(1, 4.0, 0.8));
  RenderOptions options = small(RenderStyle::lit);
  options.color_by = "mood";
  CHECK(message<InputError>(tree.scene(), options) ==
        "--color-by: the tree has no attribute 'mood' (it has order, strahler, width)");
  CHECK(message<InputError>({&tree.mesh, nullptr}, options) ==
        "--color-by: there is no attribute 'mood': the input is a mesh without a skeleton");
  CHECK(message<InputError>({&tree.mesh, nullptr}, small(RenderStyle::skeleton)) ==
        "--style: skeleton: the input is a mesh without a skeleton (lit and schematic can draw it)");
}

TEST_CASE("renderer: a mesh without a skeleton is drawn") {
  const Tree tree(pole_of(1, 4.0, 0.8));
  const Image image = Renderer().render({&tree.mesh, nullptr}, small(RenderStyle::lit));
  CHECK(brightness(image, 50, 50) < 3 * 180);
}

TEST_CASE("renderer: the same scene gives the same bytes, whatever was drawn before") {
  const Tree tree(pole_of(3, 4.0, 0.3));
  const Tree other(pole_of(2, 9.0, 0.7));
  RenderOptions options = small(RenderStyle::lit);
  options.view = *parse_view("20,30");
  options.with_scale = true;
  Renderer renderer;
  const Image first = renderer.render(tree.scene(), options);
  renderer.render(other.scene(), small(RenderStyle::skeleton));
  renderer.render(other.scene(), small(RenderStyle::lit));
  const Image again = renderer.render(tree.scene(), options);
  const Image elsewhere = Renderer().render(tree.scene(), options);
  CHECK(first.rgba == again.rgba);
  CHECK(first.rgba == elsewhere.rgba);
}

TEST_CASE("renderer: two at a time do not disturb each other") {
  const Tree tree(pole_of(1, 4.0, 0.8));
  Renderer a;
  const Image first = a.render(tree.scene(), small(RenderStyle::schematic));
  {
    Renderer b;
    CHECK(b.render(tree.scene(), small(RenderStyle::schematic)).rgba == first.rgba);
  }
  CHECK(a.render(tree.scene(), small(RenderStyle::schematic)).rgba == first.rgba);
}

TEST_CASE(
    "lit: an overlay changes colours as far as its alpha says, no outline, no shadow and no plain colours") {
  Tree tree(pole_of(3, 4.0, 0.8));
  Mesh covered = tree.mesh;
  const std::size_t first = covered.triangles.size();
  const auto count = static_cast<std::uint32_t>(covered.vertex_count());
  covered.colors.assign(count, {200, 200, 200, 255});
  tree.mesh.colors = covered.colors;
  for (std::uint32_t v = 0; v < count; ++v) {
    covered.positions.push_back(Vec3f(covered.positions[v]));
    covered.normals.push_back(Vec3f(covered.normals[v]));
    covered.uvs.push_back(Vec2f(covered.uvs[v]));
    covered.colors.push_back({255, 0, 0, 255});
    covered.internodes.push_back(covered.internodes[v]);
  }
  for (std::size_t t = 0; t < first; ++t) {
    const Triangle triangle = covered.triangles[t];
    covered.triangles.push_back({triangle[0] + count, triangle[1] + count, triangle[2] + count});
  }
  covered.materials.push_back(covered.materials[0]);
  covered.materials.back().is_overlay = true;
  covered.ranges.push_back({covered.materials.size() - 1, first, first});

  Renderer renderer;
  const auto drawn = [&](const Mesh& mesh, RenderOptions options) {
    return renderer.render({.mesh = &mesh, .skeleton = &tree.skeleton}, options);
  };
  const auto reddest = [](const Image& image) {
    int most = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
      most = std::max(most, image.rgba[i] - image.rgba[i + 1]);
    return most;
  };
  RenderOptions options = small(RenderStyle::lit);
  options.background = parse_color("transparent");
  const Image bare = drawn(tree.mesh, options);
  const Image opaque = drawn(covered, options);
  for (std::size_t v = count; v < covered.vertex_count(); ++v) covered.colors[v][3] = 128;
  const Image half = drawn(covered, options);
  CHECK(reddest(bare) < 40);
  CHECK(reddest(opaque) > 100);
  CHECK(reddest(half) > 40);
  CHECK(reddest(half) < reddest(opaque));
  for (std::size_t i = 3; i < bare.rgba.size(); i += 4) CHECK(int{opaque.rgba[i]} == int{bare.rgba[i]});
  for (std::size_t v = count; v < covered.vertex_count(); ++v) covered.colors[v][3] = 0;
  CHECK(drawn(covered, options).rgba == bare.rgba);
  const RenderOptions schematic = small(RenderStyle::schematic);
  CHECK(drawn(covered, schematic).rgba == drawn(tree.mesh, schematic).rgba);
}

TEST_CASE("renderer: a tree without internodes shows the background and the ground") {
  Skeleton seed = pole_of(1, 4.0, 0.8);
  seed.position.resize(1);
  seed.parent.resize(1);
  seed.diameter.resize(1);
  seed.axis.resize(1);
  seed.order.resize(1);
  seed.kind.resize(1);
  const Tree tree(seed);
  Renderer renderer;
  CHECK(is_white(renderer.render(tree.scene(), small(RenderStyle::schematic)), 50, 50));
  CHECK(is_white(renderer.render(tree.scene(), small(RenderStyle::skeleton)), 50, 50));
  CHECK(brightness(renderer.render(tree.scene(), small(RenderStyle::lit)), 50, 90) > 3 * 200);
  CHECK_NOTHROW(renderer.render({}, small(RenderStyle::lit)));
  RenderOptions with_scale = small(RenderStyle::schematic);
  with_scale.with_scale = true;
  CHECK(drawn_extent(renderer.render(tree.scene(), with_scale)).bottom > 0);
}

TEST_CASE("renderer: sizes from one pixel to long strips work, and too large ones are errors") {
  const Tree tree(pole_of(1, 4.0, 0.8));
  Renderer renderer;
  for (const auto& [width, height] : {std::pair{1, 1}, {16, 16}, {17, 5}, {3, 200}}) {
    for (RenderStyle style : {RenderStyle::lit, RenderStyle::schematic, RenderStyle::skeleton}) {
      RenderOptions options = small(style);
      options.width = width;
      options.height = height;
      CHECK(renderer.render(tree.scene(), options).rgba.size() == 4u * width * height);
    }
  }
  RenderOptions options = small(RenderStyle::lit);
  options.width = 1'000'000;
  CHECK(message<GraphicsError>(tree.scene(), options)
            .rfind("picture of 1000000x100 pixels: this OpenGL device draws at most", 0) == 0);
}

TEST_CASE("scale: figure and bar stand in the picture beside the tree") {
  const Tree tree(pole_of(1, 4.0, 0.4));
  RenderOptions options = small(RenderStyle::schematic);
  options.with_scale = true;
  const Image image = Renderer().render(tree.scene(), options);
  const Extent extent = drawn_extent(image);
  CHECK(extent.left >= 4);
  CHECK(extent.right <= 96);
  CHECK(extent.top >= 4);
  CHECK(extent.bottom <= 96);
  // The trunk is right of the middle now, the figure left of it.
  int figure = 0;
  int trunk = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      if (brightness(image, x, y) == 0) ++(x < 45 ? figure : trunk);
    }
  }
  CHECK(figure > 50);
  CHECK(trunk > 200);
}

TEST_CASE("renderer: with room for the other's points two trees are drawn to one scale") {
  const Tree low(pole_of(4, 1.0, 0.1));
  const Tree high(pole_of(4, 4.0, 0.1));
  RenderOptions options = small(RenderStyle::schematic);
  Renderer renderer;
  const Extent alone = drawn_extent(renderer.render(low.scene(), options));
  const Extent whole = drawn_extent(renderer.render(high.scene(), options));
  options.room_for = high.mesh.positions;
  const Extent beside = drawn_extent(renderer.render(low.scene(), options));
  CHECK(alone.bottom - alone.top == Approx(90).margin(2));
  CHECK(4 * (beside.bottom - beside.top) == Approx(whole.bottom - whole.top).margin(5));
  CHECK(beside.bottom == whole.bottom);
}
