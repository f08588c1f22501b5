#include "common/base/color.h"

#include "common/mesh/palette.h"
#include "tests/catch.h"
#include "tests/viewer/close.h"

using namespace ramify;
using namespace ramify::test;

TEST_CASE("colour: hexadecimal digits and names are read") {
  CHECK(parse_color("#ff8000") == color_of(0xff8000));
  CHECK(parse_color("#FF8000") == color_of(0xff8000));
  CHECK(parse_color("#f80") == color_of(0xff8800));
  CHECK(parse_color("white") == Color{1.0f, 1.0f, 1.0f, 1.0f});
  CHECK(parse_color("Black") == Color{0.0f, 0.0f, 0.0f, 1.0f});
  CHECK(parse_color("grey") == parse_color("gray"));
  CHECK(parse_color("lightgrey") == color_of(0xd3d3d3));
  CHECK(parse_color("skyblue") == color_of(0x87ceeb));
}

TEST_CASE("colour: transparency is read") {
  CHECK(parse_color("transparent")->a == 0.0f);
  const auto half = parse_color("#11223380");
  REQUIRE(half);
  CHECK(half->r == color_of(0x112233).r);
  CHECK(half->b == color_of(0x112233).b);
  CHECK(is_close(half->a, 128.0 / 255.0));
}

TEST_CASE("colour: anything else is refused") {
  for (const char* text : {"", "#", "#12", "#1234", "#12345", "#1234567", "#123456789", "#ggg", "ff8000",
                           "#-12345", "wihte", "#12 456"}) {
    INFO(text);
    CHECK_FALSE(parse_color(text));
  }
}

TEST_CASE("palette: the sequential map runs from viridis' dark blue to its yellow, ever lighter") {
  CHECK(sequential_color(0.0) == color_of(0x440154));
  CHECK(sequential_color(1.0) == color_of(0xfde725));
  CHECK(sequential_color(-3.0) == sequential_color(0.0));
  CHECK(sequential_color(7.0) == sequential_color(1.0));
  const auto lightness = [](const Color& color) { return 0.2 * color.r + 0.7 * color.g + 0.1 * color.b; };
  for (int step = 0; step < 20; ++step) {
    CHECK(lightness(sequential_color(step / 20.0)) < lightness(sequential_color((step + 1) / 20.0)));
  }
}

TEST_CASE("palette: neighbouring categories differ") {
  for (std::size_t index = 0; index < 30; ++index) {
    CHECK_FALSE(categorical_color(index) == categorical_color(index + 1));
  }
}
