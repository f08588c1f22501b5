#include "viewer/slider_range.h"

#include "tests/catch.h"
#include "tests/viewer/close.h"

using namespace ramify;
using ramify::test::is_close;

TEST_CASE("slider range: shares and degrees have all of their range") {
  CHECK(slider_range({.min = 0, .max = 1}, 0.5, 0.5).high == 1.0);
  CHECK(slider_range({.min = 0, .max = 180, .unit = "degrees"}, 2.0, 2.0).high == 180.0);
  CHECK(slider_range({.min = 0, .max = 10}, 1.0, 1.0).high == 10.0);
}

TEST_CASE("slider range: a wide range shrinks to some times the value, which stays inside") {
  const FieldInfo info{.min = 0, .max = 1e6};
  CHECK(is_close(slider_range(info, 2.0, 2.0).high, 10.0));
  CHECK(is_close(slider_range(info, 77.0, 2.0).high, 77.0));
  CHECK(slider_range(info, 0.0, 0.0).high == 1.0);
  CHECK(slider_range({.min = -1e4, .max = 1e4}, -3.0, -3.0).low <= -3.0);
}

TEST_CASE("slider range: where the least itself is not allowed the slider ends above it") {
  const SliderRange range = slider_range({.min = 0, .max = 1, .is_above_min = true}, 0.5, 0.5);
  CHECK(range.low > 0.0);
  CHECK(range.low < 0.01);
}
