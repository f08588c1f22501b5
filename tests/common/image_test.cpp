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

TEST_CASE("picture: a PNG with as few channels as it needs reads back") {
  const std::vector<std::vector<std::uint8_t>> pixels = {
      {7, 7, 7, 255, 200, 200, 200, 255}, {1, 2, 3, 255, 4, 5, 6, 255}, {1, 2, 3, 0, 4, 5, 6, 77}};
  const char color_types[] = {0, 2, 6};  // grey, RGB, RGBA
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::string png = png_bytes({2, 1, pixels[i]});
    CHECK(png[25] == color_types[i]);
    const Image again = decoded_image(png, "a.png");
    CHECK(again.width == 2);
    CHECK(again.height == 1);
    CHECK(again.rgba == pixels[i]);
  }
}

TEST_CASE("picture: images that cannot be read are told in a line, whatever they claim") {
  const auto error_of = [](const std::string& bytes) {
    try {
      decoded_image(bytes, "a.png");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const std::string png = png_bytes(counting_image(16, 16, 3));
  CHECK(error_of("").rfind("a.png: no PNG or JPEG image: ", 0) == 0);
  CHECK(error_of("garbage").rfind("a.png: no PNG or JPEG image: ", 0) == 0);
  CHECK(error_of(png.substr(0, png.size() / 2)).rfind("a.png: damaged image: ", 0) == 0);
  std::string lying = png;
  lying.replace(16, 8, std::string("\0\0\x1f\xff\0\0\x1f\xff", 8));
  CHECK(error_of(lying).rfind("a.png: claims 8191 x 8191 pixels in ", 0) == 0);
  lying.replace(16, 8, std::string("\0\0\xff\xff\0\0\0\1", 8));
  CHECK(error_of(lying) == "a.png: 65535 x 1 pixels (at most 8192 x 8192)");
}
