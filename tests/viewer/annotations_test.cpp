#include "viewer/annotations.h"

#include <algorithm>

#include "tests/catch.h"
#include "tests/viewer/close.h"

using namespace ramify;
using namespace ramify::test;

TEST_CASE("scale bar: its length is 1, 2 or 5 times a power of ten, and not above what is asked for") {
  CHECK(is_close(bar_length(1.0), 1.0));
  CHECK(is_close(bar_length(1.99), 1.0));
  CHECK(is_close(bar_length(2.0), 2.0));
  CHECK(is_close(bar_length(4.9), 2.0));
  CHECK(is_close(bar_length(7.0), 5.0));
  CHECK(is_close(bar_length(0.05), 0.05));
  CHECK(is_close(bar_length(1234.0), 1000.0));
  for (double length = 1e-3; length < 1e4; length *= 1.07) {
    CHECK(bar_length(length) <= length * (1.0 + 1e-9));
    CHECK(bar_length(length) * 2.5 > length);
  }
}

TEST_CASE("scale bar: the label is the length in a fitting unit") {
  CHECK(length_label(bar_length(0.002)) == "2 mm");
  CHECK(length_label(bar_length(0.06)) == "5 cm");
  CHECK(length_label(bar_length(0.25)) == "20 cm");
  CHECK(length_label(bar_length(1.5)) == "1 m");
  CHECK(length_label(bar_length(70)) == "50 m");
  CHECK(length_label(bar_length(2500)) == "2 km");
}

TEST_CASE("scale: the figure is 1.75 m tall, stands on the ground and is clear of the tree") {
  const Annotations annotations = make_annotations({-3.0, 0.0}, {2.0, 8.0});
  float low = 1e9f;
  float high = -1e9f;
  float right = -1e9f;
  for (const Vec2f& corner : annotations.figure) {
    low = std::min(low, corner.y);
    high = std::max(high, corner.y);
    right = std::max(right, corner.x);
  }
  CHECK(std::abs(low) < 1e-3f);
  CHECK(is_close(high, kFigureHeight, 1e-3));
  CHECK(right < -3.0f);
}

TEST_CASE("scale bar: it is drawn as long as it says, below the tree") {
  const Annotations annotations = make_annotations({-3.0, -0.5}, {2.0, 8.0});
  const auto [left, right] = std::minmax_element(annotations.bar.begin(), annotations.bar.begin() + 6,
                                                 [](const Vec2f& a, const Vec2f& b) { return a.x < b.x; });
  CHECK(is_close(right->x - left->x, bar_length(0.3 * 8.5)));
  for (const Vec2f& corner : annotations.bar) CHECK(corner.y < -0.5f);
}

TEST_CASE("scale bar: every length has a label that can be drawn") {
  for (double size = 2.0; size < 1e5; size *= 1.5) {
    CHECK(make_annotations({0.0, 0.0}, {1.0, size}).bar.size() > 18);
  }
}
