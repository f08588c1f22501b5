#include "viewer/image.h"

#include <array>
#include <sstream>

#include "common/base/errors.h"
#include "tests/catch.h"

using namespace ramify;

namespace {

/// Every byte counts up from `first`.
Image counting_image(int width, int height, int first) {
  Image image{width, height, {}};
  for (int byte = 0; byte < 4 * width * height; ++byte) {
    image.rgba.push_back(static_cast<std::uint8_t>(first + byte));
  }
  return image;
}

}  // namespace

TEST_CASE("picture: a PNG begins with its signature and says its size") {
  std::ostringstream out;
  write_png(counting_image(3, 2, 0), out);
  const std::string png = out.str();
  REQUIRE(png.size() > 33);
  CHECK(png.substr(0, 8) == "\x89PNG\r\n\x1a\n");
  CHECK(png.substr(12, 4) == "IHDR");
  CHECK(png.substr(16, 8) == std::string("\0\0\0\3\0\0\0\2", 8));
  CHECK(png.substr(png.size() - 8, 4) == "IEND");
}

TEST_CASE("picture: a stream that fails is an error") {
  std::ostringstream out;
  out.setstate(std::ios::badbit);
  CHECK_THROWS_AS(write_png(counting_image(3, 2, 0), out), IoError);
}

TEST_CASE("picture: images stand beside each other from left to right") {
  const std::array<Image, 3> images = {counting_image(2, 2, 0), counting_image(1, 2, 100),
                                       counting_image(3, 2, 200)};
  const Image row = beside(images);
  CHECK(row.width == 6);
  CHECK(row.height == 2);
  REQUIRE(row.rgba.size() == 4u * 6u * 2u);
  for (int y = 0; y < 2; ++y) {
    CHECK(row.pixel(0, y)[0] == images[0].pixel(0, y)[0]);
    CHECK(row.pixel(1, y)[3] == images[0].pixel(1, y)[3]);
    CHECK(row.pixel(2, y)[1] == images[1].pixel(0, y)[1]);
    CHECK(row.pixel(5, y)[2] == images[2].pixel(2, y)[2]);
  }
  CHECK(beside({}).rgba.empty());
}
