#include "common/base/image.h"

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

TEST_CASE("picture: images stand in rows from left to right, and what the last row lacks is transparent") {
  const std::array<Image, 3> images = {counting_image(2, 2, 0), counting_image(2, 2, 100),
                                       counting_image(2, 2, 200)};
  const Image sheet = contact_sheet(images, 2);
  CHECK(sheet.width == 4);
  CHECK(sheet.height == 4);
  REQUIRE(sheet.rgba.size() == 4u * 4u * 4u);
  for (int y = 0; y < 2; ++y) {
    CHECK(sheet.pixel(0, y)[0] == images[0].pixel(0, y)[0]);
    CHECK(sheet.pixel(1, y)[3] == images[0].pixel(1, y)[3]);
    CHECK(sheet.pixel(2, y)[1] == images[1].pixel(0, y)[1]);
    CHECK(sheet.pixel(1, 2 + y)[2] == images[2].pixel(1, y)[2]);
    CHECK(sheet.pixel(2, 2 + y)[3] == 0);
    CHECK(sheet.pixel(3, 2 + y)[0] == 0);
  }
  CHECK(contact_sheet({}, 1).rgba.empty());
}

TEST_CASE("picture: more columns than images make one row") {
  const std::array<Image, 2> images = {counting_image(2, 1, 0), counting_image(2, 1, 100)};
  const Image row = contact_sheet(images, 7);
  CHECK(row.width == 4);
  CHECK(row.height == 1);
  CHECK(row.pixel(3, 0)[2] == images[1].pixel(1, 0)[2]);
}
