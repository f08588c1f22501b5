#include "common/mesh/attribute_colors.h"

#include "common/base/errors.h"
#include "common/mesh/palette.h"
#include "tests/catch.h"
#include "tests/viewer/close.h"
#include "tests/viewer/poles.h"

using namespace ramify;
using namespace ramify::test;

TEST_CASE("attributes: only those that the skeleton has are offered") {
  Skeleton skeleton = pole_of(3, 1.0, 0.1);
  CHECK(color_attributes(skeleton) == std::vector<std::string>{"order", "strahler", "width"});
  skeleton.birth_step.assign(4, 1);
  skeleton.light.assign(4, 0.5f);
  skeleton.vigour.assign(4, 0.5f);
  skeleton.level.assign(4, 1);
  skeleton.channels["age"].assign(4, 2.0);
  CHECK(color_attributes(skeleton) == std::vector<std::string>{"order", "strahler", "width", "birthStep",
                                                               "level", "light", "vigour", "age"});
  for (const std::string& name : color_attributes(skeleton)) {
    CHECK(attribute_colors(skeleton, name).size() == skeleton.node_count());
  }
}

TEST_CASE("attributes: an unknown one is an error that names those there are") {
  try {
    attribute_colors(pole_of(3, 1.0, 0.1), "lite");
    FAIL("no error");
  } catch (const InputError& error) {
    CHECK(std::string(error.what()) ==
          "--color-by: the tree has no attribute 'lite' (it has order, strahler, width)");
  }
}

TEST_CASE("attributes: each order has its colour") {
  Skeleton skeleton = pole_of(3, 1.0, 0.1);
  skeleton.order = {0, 0, 1, 2};
  const std::vector<Color> colors = attribute_colors(skeleton, "order");
  CHECK(colors[1] == categorical_color(0));
  CHECK(colors[2] == categorical_color(1));
  CHECK(colors[3] == categorical_color(2));
}

TEST_CASE("attributes: a value runs from the least to the greatest among the internodes") {
  Skeleton skeleton = pole_of(3, 1.0, 0.1);
  skeleton.birth_step = {0, 11, 12, 13};
  const std::vector<Color> colors = attribute_colors(skeleton, "birthStep");
  CHECK(colors[1] == sequential_color(0.0));
  CHECK(colors[2] == sequential_color(0.5));
  CHECK(colors[3] == sequential_color(1.0));
}

TEST_CASE("attributes: widths run by their logarithm, and equal ones are one colour") {
  Skeleton skeleton = pole_of(3, 1.0, 0.1);
  skeleton.diameter = {0.4, 0.4, 0.04, 0.004};
  const std::vector<Color> colors = attribute_colors(skeleton, "width");
  CHECK(is_close(colors[2].g, sequential_color(0.5).g, 1e-4));
  skeleton.diameter.assign(4, 0.1);
  CHECK(attribute_colors(skeleton, "width")[1] == attribute_colors(skeleton, "width")[3]);
}

TEST_CASE("attributes: light of 0 stands at the low end") {
  Skeleton skeleton = pole_of(3, 1.0, 0.1);
  skeleton.light = {0.0f, 8.0f, 1.0f, 0.0f};
  const std::vector<Color> colors = attribute_colors(skeleton, "light");
  CHECK(colors[1] == sequential_color(1.0));
  CHECK(colors[2] == sequential_color(0.0));
  CHECK(colors[3] == sequential_color(0.0));
}
