#include "common/analysis/distances.h"

#include <algorithm>
#include <cmath>

#include "common/skeleton/passes.h"
#include "tests/catch.h"
#include "tests/common/trees.h"

using namespace ramify;
using namespace ramify::test;

namespace {

using Distance = double (*)(const TreeForm&, const TreeForm&);
const std::vector<Distance> kDistances = {scatter_distance, morphology_distance, shape_distance};

}  // namespace

TEST_CASE("distances: 0 for a tree with itself and the same in both directions") {
  std::vector<TreeForm> forms = {form_of(pole(3)), form_of(binary_tree(5))};
  for (std::uint64_t seed = 1; seed <= 4; ++seed) forms.push_back(form_of(random_tree(seed, 2500)));
  for (const Distance distance : kDistances) {
    for (std::size_t i = 0; i < forms.size(); ++i) {
      CHECK(distance(forms[i], forms[i]) == 0.0);
      for (std::size_t j = 0; j < i; ++j) {
        CHECK(distance(forms[i], forms[j]) > 0.0);
        CHECK(distance(forms[i], forms[j]) == distance(forms[j], forms[i]));
        CHECK(distance(forms[i], forms[j]) <= 1.0);
      }
    }
  }
}

TEST_CASE("distances: a tree's branches end where they meet longer ones") {
  Skeleton s = pole(4);  // a lateral of 1 m at 1 m, one of 5 m at 3 m
  for (const auto& [parent, end] : {std::pair(1u, Vec3(1, 1, 0)), std::pair(3u, Vec3(5, 3, 0))}) {
    s.position.push_back(end);
    s.parent.push_back(parent);
    s.diameter.push_back(0.05);
    s.kind.push_back(Kind::stem);
  }
  assign_axes(s);
  std::vector<Bar> bars = form_of(s).barcode;
  REQUIRE(bars.size() == 3);
  std::sort(bars.begin(), bars.end(), [](const Bar& a, const Bar& b) { return a.tip < b.tip; });
  CHECK(bars[0].tip == Approx(2.0));
  CHECK(bars[0].fork == Approx(1.0));
  CHECK(bars[1].tip == Approx(4.0));  // the trunk ends at the fork where the long lateral goes on
  CHECK(bars[1].fork == Approx(3.0));
  CHECK(bars[2].tip == Approx(8.0));
  CHECK(bars[2].fork == 0.0);
}

TEST_CASE("distances: of two poles, by hand") {
  const TreeForm one = form_of(pole(3));
  const TreeForm two = form_of(pole(4));
  // One bar each, (0, 3) and (0, 4): 1 m apart along (fork, tip), seen from 32 directions.
  double mean_sine = 0.0;
  for (int i = 0; i < 32; ++i) mean_sine += std::sin(std::acos(-1.0) * i / 32) / 32;
  CHECK(morphology_distance(one, two) == Approx(mean_sine / 4.0));
  // Height and mean height of the tips are 3 and 4 m, the other features 0.
  CHECK(shape_distance(one, two) == Approx(2.0 / 6.0 * (1 - std::exp(-std::pow(1 / 3.5 / 0.25, 2) / 2))));
}

TEST_CASE("distances: a branch's row says how it stands on its bearer") {
  Skeleton s = pole(4);
  s.position.push_back(Vec3(0, 3, -2));
  s.parent.push_back(3);
  s.diameter.push_back(0.06);
  s.kind.push_back(Kind::stem);
  assign_axes(s);
  const TreeForm form = form_of(s);
  REQUIRE(form.scatter.size() == 2);
  REQUIRE(form.scatter[1].branches.size() == 1);
  const auto [angle, azimuth, length, radius, place] = form.scatter[1].branches[0];
  CHECK(angle == Approx(90.0));
  CHECK(std::abs(azimuth) == Approx(90.0));  // from +X
  CHECK(length == Approx(2.0));
  CHECK(radius == Approx(0.03));
  CHECK(place == Approx(0.75));
  REQUIRE(form.scatter[0].segments.size() == 4);
  const auto [width, elevation, along, path] = form.scatter[1].segments[0];
  CHECK(width == Approx(0.03));
  CHECK(elevation == Approx(0.0).margin(1e-9));
  CHECK(along == Approx(2.0));
  CHECK(path == Approx(5.0));
}

TEST_CASE("distances: a tree is nearer to one a little changed than to one changed much") {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Skeleton tree = living(random_tree(seed, 1500));
    const auto stretched = [&](double factor) {
      Skeleton s = tree;
      for (Vec3& position : s.position) position.y *= factor;
      return form_of(s);
    };
    for (const Distance distance : kDistances) {
      const TreeForm form = form_of(tree);
      CHECK(distance(form, stretched(1.05)) < distance(form, stretched(1.5)));
      CHECK(distance(form, stretched(1.5)) < distance(form, stretched(3.0)));
    }
  }
}

TEST_CASE("distances: trees that are roots alone") {
  const TreeForm root = form_of(subset(pole(1), {true, false}));
  for (const Distance distance : kDistances) {
    CHECK(distance(root, root) == 0.0);
    CHECK(distance(root, form_of(pole(2))) > 0.0);
  }
}
