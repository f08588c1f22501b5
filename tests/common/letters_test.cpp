// Text in pictures.

#include "common/base/letters.h"

#include <algorithm>

#include "tests/catch.h"

using namespace ramify;

namespace {

constexpr ColorBytes kInk{10, 20, 30, 255};

Image paper(int width, int height) {
  Image image{width, height, {}};
  image.rgba.assign(4 * static_cast<std::size_t>(width) * height, 255);
  return image;
}

/// The first and last column that has ink, and how many pixels have.
struct Ink {
  int first = -1;
  int last = -1;
  int pixels = 0;
};

Ink ink_of(const Image& image) {
  Ink ink;
  for (int x = 0; x < image.width; ++x) {
    for (int y = 0; y < image.height; ++y) {
      if (image.pixel(x, y)[0] > 128) continue;
      if (ink.first < 0) ink.first = x;
      ink.last = x;
      ++ink.pixels;
    }
  }
  return ink;
}

}  // namespace

TEST_CASE("letters: a text is as wide as it says") {
  const Letters letters(16.0f);
  if (!letters.can_draw()) return;  // no font is installed
  CHECK(letters.width("") == 0.0f);
  CHECK(letters.width("mm") > 3.0f * letters.width("i"));
  Image image = paper(200, 24);
  letters.draw(image, 5, 2, "lambda = 0.5", kInk);
  const Ink ink = ink_of(image);
  CHECK(ink.first >= 5);
  CHECK(ink.last < 5 + static_cast<int>(letters.width("lambda = 0.5")) + 1);
  CHECK(ink.last > 5 + static_cast<int>(letters.width("lambda = 0.5")) - 4);
  CHECK(ink.pixels > 100);
  CHECK(ink.pixels < 1000);
  CHECK(image.pixel(199, 23)[3] == 255);
}

TEST_CASE("letters: what does not fit is cut off") {
  const Letters letters(16.0f);
  if (!letters.can_draw()) return;
  Image image = paper(20, 10);
  letters.draw(image, -7, -3, "wider and higher", kInk);
  CHECK(image.rgba.size() == 4 * 20 * 10);
  CHECK(ink_of(image).pixels > 10);
}

TEST_CASE("letters: other letters than those of ASCII are question marks, one a byte") {
  const Letters letters(16.0f);
  if (!letters.can_draw()) return;
  CHECK(letters.width("\xc3\xa4") == letters.width("??"));
}
