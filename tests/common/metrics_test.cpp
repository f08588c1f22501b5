// Trees whose measures are known without a program.

#include "common/analysis/metrics.h"

#include <cmath>
#include <numbers>

#include "common/analysis/anatomy.h"
#include "common/analysis/measures.h"
#include "common/analysis/metrics_json.h"
#include "common/analysis/statistics.h"
#include "common/skeleton/passes.h"
#include "tests/catch.h"
#include "tests/common/trees.h"

#include <nlohmann/json.hpp>

using namespace ramify;
using namespace ramify::test;

namespace {

/// A skeleton by hand: nodes after each other, axes by name.
class Builder {
 public:
  explicit Builder(const Vec3& root = Vec3(0.0)) { put(root, kNoParent, 1.0, 0); }

  /// The new node's index.
  std::uint32_t add(std::uint32_t parent, const Vec3& position, double diameter, std::uint32_t axis) {
    put(position, parent, diameter, axis);
    return static_cast<std::uint32_t>(s_.node_count() - 1);
  }
  Skeleton take() {
    assign_orders(s_);
    return s_;
  }

 private:
  void put(const Vec3& position, std::uint32_t parent, double diameter, std::uint32_t axis) {
    s_.position.push_back(position);
    s_.parent.push_back(parent);
    s_.diameter.push_back(diameter);
    s_.axis.push_back(axis);
    s_.kind.push_back(Kind::stem);
  }

  Skeleton s_;
};

/// A trunk of `count` internodes of 1 m; each of its nodes but the last bears a lateral of 0.5 m at 60
/// degrees, 137.5 degrees about the trunk from the one below.
Skeleton herringbone(int count) {
  Builder tree;
  std::uint32_t top = 0;
  for (int i = 1; i <= count; ++i) {
    top = tree.add(top, Vec3(0, i, 0), 0.1, 0);
    if (i == count) break;
    const double azimuth = radians(137.5 * i);
    const Vec3 aside(std::sin(radians(60)) * std::cos(azimuth), std::cos(radians(60)),
                     std::sin(radians(60)) * std::sin(azimuth));
    tree.add(top, Vec3(0, i, 0) + 0.5 * aside, 0.02, static_cast<std::uint32_t>(i));
  }
  return tree.take();
}

/// Each internode bears two at 30 degrees to either side, half as long and 0.7 times as thick, `depth` times.
Skeleton even_forks(int depth) {
  Builder tree;
  std::vector<std::uint32_t> level = {tree.add(0, Vec3(0, 1, 0), 1.0, 0)};
  std::vector<Vec3> along = {Vec3(0, 1, 0)};
  std::vector<std::uint32_t> axis = {0};
  std::vector<Vec3> position = {Vec3(0), Vec3(0, 1, 0)};
  std::uint32_t next_axis = 1;
  for (int i = 1; i <= depth; ++i) {
    const double width = std::pow(0.7, i);
    std::vector<std::uint32_t> next;
    std::vector<Vec3> next_along;
    std::vector<std::uint32_t> next_axes;
    for (std::size_t k = 0; k < level.size(); ++k) {
      for (const double side : {-1.0, 1.0}) {
        next_along.push_back(0.5 * rotated(along[k], Vec3(0, 0, 1), radians(30.0 * side)));
        next_axes.push_back(side < 0 ? axis[k] : next_axis++);
        position.push_back(position[level[k]] + next_along.back());
        next.push_back(tree.add(level[k], position.back(), width, next_axes.back()));
      }
    }
    level = next;
    along = next_along;
    axis = next_axes;
  }
  return tree.take();
}

Approx near(double value) {
  return Approx(value).epsilon(1e-9);
}

}  // namespace

TEST_CASE("metrics: a pole") {
  const Metrics m = measure(pole(4));  // 0.2 m thick at the base, 0.1 m at the top
  CHECK(m.nodes == 5);
  CHECK(m.internodes == 4);
  CHECK(m.axes == 1);
  CHECK(m.max_order == 0.0);
  CHECK(*m.height == near(4.0));
  CHECK(*m.crown_radius == near(0.0));
  CHECK_FALSE(m.crown_height);
  CHECK_FALSE(m.crown_volume);
  CHECK(*m.trunk_diameter == near(0.175));
  CHECK(*m.dbh == near(0.175 - 0.3 * 0.025));
  CHECK(m.total_length == near(4.0));
  // The first internode is as thick at its start as at its end; above, a cone from 0.175 to 0.1 m.
  const double pi = std::numbers::pi;
  const double cylinder = pi * 0.0875 * 0.0875;
  const double cone = pi / 3 * 3.0 * (0.0875 * 0.0875 + 0.0875 * 0.05 + 0.05 * 0.05);
  CHECK(m.wood_volume == near(cylinder + cone));
  CHECK(m.surface_area == near(2 * pi * 0.0875 + pi * (0.0875 + 0.05) * std::hypot(3.0, 0.0375)));
  CHECK(*m.strahler_order == 1.0);
  CHECK_FALSE(m.bifurcation_ratio);
  CHECK_FALSE(m.length_ratio);
  CHECK_FALSE(m.diameter_ratio);
  CHECK_FALSE(m.branching_angle_mean_deg);
  CHECK_FALSE(m.branching_angle_sd_deg);
  CHECK_FALSE(m.divergence_angle_mean_deg);
  CHECK(*m.internode_length_mean == near(1.0));
  CHECK(*m.tortuosity_mean == near(1.0));
  CHECK(*m.path_length_mean == near(4.0));
  CHECK(*m.path_length_max == near(4.0));
  CHECK(*m.path_fraction == near(1.0));
  CHECK(*m.fractal_dimension == near(1.0));
  CHECK_FALSE(m.asymmetry);
  CHECK(*m.lean == near(0.0));
  CHECK_FALSE(m.pipe_exponent);
  REQUIRE(m.by_order.size() == 1);
  CHECK(m.by_order[0].axes == 1);
  CHECK(m.by_order[0].length == near(4.0));
  CHECK(m.by_order[0].volume == near(cylinder + cone));
  CHECK_FALSE(m.by_order[0].angle_mean_deg);
  CHECK_FALSE(m.by_order[0].angle_median_deg);
  CHECK(*m.by_order[0].tortuosity_mean == near(1.0));
}

TEST_CASE("metrics: a perfect binary tree") {
  const Metrics m = measure(even_forks(6));
  CHECK(m.internodes == 127);
  CHECK(m.axes == 64);
  CHECK(*m.strahler_order == 7.0);
  CHECK(*m.bifurcation_ratio == near(2.0));
  CHECK(*m.length_ratio == near(2.0));
  CHECK(*m.diameter_ratio == near(1.0 / 0.7));
  CHECK(*m.branching_angle_mean_deg == near(30.0));
  CHECK(*m.branching_angle_sd_deg == Approx(0.0).margin(1e-9));
  CHECK(*m.path_length_mean == near(2.0 - std::pow(0.5, 6)));
  CHECK(*m.path_fraction == near(1.0));
  CHECK(*m.asymmetry == near(0.0));
  CHECK(*m.pipe_exponent == near(std::log(2.0) / std::log(1.0 / 0.7)));
  CHECK(*m.lean == Approx(0.0).margin(0.05));  // but for the cones, it is even
  CHECK_FALSE(m.crown_volume);                 // all in one plane
  REQUIRE(m.by_order.size() == 7);
  const std::vector<std::size_t> axes = {1, 6, 15, 20, 15, 6, 1};
  for (std::size_t order = 0; order < 7; ++order) {
    CHECK(m.by_order[order].order == order);
    CHECK(m.by_order[order].axes == axes[order]);
    if (order > 0) CHECK(*m.by_order[order].angle_median_deg == near(30.0));
  }
}

TEST_CASE("metrics: a herringbone") {
  const Metrics m = measure(herringbone(8));
  CHECK(m.axes == 8);
  CHECK(*m.max_order == 1.0);
  CHECK(*m.strahler_order == 2.0);
  CHECK(*m.bifurcation_ratio == near(8.0));  // 7 laterals and the trunk's last internode bear nothing
  CHECK(*m.length_ratio == near(7.0 / (4.5 / 8)));
  CHECK(*m.diameter_ratio == near(0.1 / ((7 * 0.02 + 0.1) / 8)));
  CHECK(*m.branching_angle_mean_deg == near(60.0));
  CHECK(*m.branching_angle_sd_deg == Approx(0.0).margin(1e-9));
  CHECK(*m.divergence_angle_mean_deg == near(137.5));
  CHECK(*m.asymmetry == near(1.0));
  CHECK(*m.height == near(8.0));
  CHECK(*m.crown_height == near(6.0));  // from 1.25 m to 7.25 m
  CHECK(m.total_length == near(8 + 3.5));
  CHECK(*m.crown_radius == near(0.5 * std::sin(radians(60))));
  CHECK(*m.path_length_max == near(8.0));
  CHECK(*m.path_length_mean == near((8.0 + (1 + 2 + 3 + 4 + 5 + 6 + 7) + 3.5) / 8));
  CHECK(*m.tortuosity_mean == near(1.0));  // of the trunk alone: the laterals are too short
  CHECK_FALSE(m.pipe_exponent);            // the trunk does not get thinner at its forks
  CHECK(*m.by_order[1].angle_mean_deg == near(60.0));
  CHECK_FALSE(m.by_order[1].tortuosity_mean);
}

TEST_CASE("metrics: pairs of opposite laterals") {
  Builder tree;
  std::uint32_t top = 0;
  for (std::uint32_t i = 1; i <= 4; ++i) {
    top = tree.add(top, Vec3(0, i, 0), 0.1, 0);
    const Vec3 aside = i % 2 == 0 ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
    tree.add(top, Vec3(0, i, 0) + aside, 0.05, 2 * i);
    tree.add(top, Vec3(0, i, 0) - aside, 0.05, 2 * i + 1);
  }
  const Metrics m = measure(tree.take());
  CHECK(*m.branching_angle_mean_deg == near(90.0));
  CHECK(*m.divergence_angle_mean_deg == near((4 * 180.0 + 3 * 90.0) / 7));
}

TEST_CASE("metrics: divergence is about the axis also where it bends") {
  // A trunk that turns through a quarter circle; its laterals stand square to its plane, on alternate sides.
  Builder tree;
  std::uint32_t top = 0;
  Vec3 at(0.0);
  for (std::uint32_t i = 0; i < 10; ++i) {
    at += Vec3(std::sin(radians(10.0 * i)), std::cos(radians(10.0 * i)), 0);
    top = tree.add(top, at, 0.1, 0);
    tree.add(top, at + Vec3(0, 0, i % 2 == 0 ? 1 : -1), 0.05, i + 1);
  }
  CHECK(*measure(tree.take()).divergence_angle_mean_deg == near(180.0));
}

TEST_CASE("metrics: the tortuosity of a helix") {
  constexpr int kTurns = 3;
  constexpr int kInTurn = 48;
  Builder tree(Vec3(1, 0, 0));
  std::uint32_t top = 0;
  for (int i = 1; i <= kTurns * kInTurn; ++i) {
    const double angle = 2 * std::numbers::pi * i / kInTurn;
    top = tree.add(top, Vec3(std::cos(angle), 2.0 * i / kInTurn, std::sin(angle)), 0.1, 0);
  }
  const double chord_of_step = 2 * std::sin(std::numbers::pi / kInTurn);
  const double arc = kInTurn * std::hypot(chord_of_step, 2.0 / kInTurn);  // of a turn 2 m high
  CHECK(*measure(tree.take()).tortuosity_mean == near(arc / 2.0));
}

TEST_CASE("metrics: a crown between the corners of a cube") {
  Builder tree;
  const std::uint32_t middle = tree.add(0, Vec3(0, 3, 0), 0.2, 0);
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    const Vec3 aside(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    tree.add(middle, Vec3(0, 3, 0) + aside, 0.05, corner + 1);
  }
  const Metrics m = measure(tree.take());
  CHECK(*m.crown_volume == near(8.0));
  CHECK(*m.crown_height == near(2.0));
  CHECK(*m.crown_radius == near(std::sqrt(2.0)));
  CHECK(*m.pipe_exponent == near(std::log(8.0) / std::log(4.0)));
  CHECK(*m.asymmetry == Approx(0.0).margin(1e-9));  // pairs of single tips have none
}

TEST_CASE("metrics: asymmetry of a fork of one tip and three") {
  Builder tree;
  const std::uint32_t fork = tree.add(0, Vec3(0, 1, 0), 0.3, 0);
  tree.add(fork, Vec3(1, 2, 0), 0.1, 0);
  std::uint32_t other = tree.add(fork, Vec3(-1, 2, 0), 0.2, 1);
  tree.add(other, Vec3(-1, 3, 0), 0.1, 1);
  tree.add(other, Vec3(-2, 3, 0), 0.1, 2);
  tree.add(other, Vec3(-2, 3, 1), 0.1, 3);
  CHECK(*measure(tree.take()).asymmetry == near(1.0));
}

TEST_CASE("metrics: a pole at 45 degrees leans by half its height") {
  Builder tree(Vec3(5, 2, -3));
  tree.add(0, Vec3(7, 4, -3), 0.1, 0);
  const Metrics m = measure(tree.take());
  CHECK(*m.lean == near(0.5));
  CHECK(*m.height == near(2.0));
  CHECK_FALSE(m.tortuosity_mean);
}

TEST_CASE("metrics: a plane full of lines has dimension 2") {
  Builder tree(Vec3(0, 0, 0));
  std::uint32_t at = 0;
  constexpr int kLines = 256;
  for (int i = 0; i <= kLines; ++i) {
    const double x = static_cast<double>(i) / kLines;
    at = tree.add(at, Vec3(x, i % 2 == 0 ? 1 : 0, 0), 0.01, 0);
    if (i < kLines) at = tree.add(at, Vec3(x + 1.0 / kLines, i % 2 == 0 ? 1 : 0, 0), 0.01, 0);
  }
  CHECK(*measure(tree.take()).fractal_dimension == near(2.0));
}

TEST_CASE("metrics: breast height is above the root, and no small tree has a diameter there") {
  CHECK_FALSE(measure(pole(1)).dbh);
  Builder tree(Vec3(0, 100, 0));
  const std::uint32_t fork = tree.add(0, Vec3(0, 101, 0), 0.5, 0);
  tree.add(fork, Vec3(0, 102, 0), 0.3, 0);
  tree.add(fork, Vec3(1, 102, 0), 0.4, 1);  // founds an axis: as thick from its start on
  CHECK(*measure(tree.take()).dbh == near(0.5 * 0.7 + 0.3 * 0.3));
}

TEST_CASE("metrics: a tree that is a root alone defines next to nothing") {
  const Skeleton root = Builder().take();
  REQUIRE(violations(root).empty());
  const nlohmann::ordered_json json = metrics_json(measure(root));
  for (const auto& [key, value] : json.items()) {
    INFO(key);
    if (key == "nodes") CHECK(value == 1);
    if (key == "internodes" || key == "axes" || key == "total_length" || key == "wood_volume" ||
        key == "surface_area") {
      CHECK(value == 0);
    } else if (key == "by_order") {
      CHECK(value.empty());
    } else if (key != "nodes") {
      CHECK(value.is_null());
    }
  }
}

TEST_CASE("metrics: internodes without length define no angle and no chord") {
  Builder tree;
  std::uint32_t top = tree.add(0, Vec3(0, 0, 0), 0.1, 0);
  top = tree.add(top, Vec3(0, 0, 0), 0.1, 0);
  tree.add(top, Vec3(0, 0, 0), 0.1, 0);
  tree.add(top, Vec3(0, 0, 0), 0.05, 1);
  const nlohmann::ordered_json json = metrics_json(measure(tree.take()));
  for (const auto& [key, value] : json.items()) {
    INFO(key);
    CHECK((!value.is_number_float() || std::isfinite(value.get<double>())));
    if (key == "branching_angle_mean" || key == "tortuosity_mean" || key == "lean" ||
        key == "fractal_dimension" || key == "path_fraction" || key == "divergence_angle_mean") {
      CHECK(value.is_null());
    }
  }
}

TEST_CASE("metrics: a scanned cylinder is as thick at its start as its channel says") {
  Skeleton s = pole(2);
  s.channels["start_radius"] = {0.1, 0.5 * s.diameter[1], 0.5 * s.diameter[2]};
  const double pi = std::numbers::pi;
  CHECK(measure(s).wood_volume == near(pi * (0.075 * 0.075 + 0.05 * 0.05)));
}

TEST_CASE("metrics: shed internodes do not count, nor do roots as a part of the stem") {
  Skeleton s = herringbone(5);
  const Metrics whole = measure(s);
  s.shed_step.assign(s.node_count(), kAlive);
  s.shed_step[s.node_count() - 2] = 7;  // the last lateral
  const Metrics part = measure(s);
  CHECK(part.internodes == whole.internodes - 1);
  CHECK(part.axes == whole.axes - 1);

  Skeleton planted = herringbone(5);
  planted.position.push_back(Vec3(3, -4, 0));
  planted.parent.push_back(0);
  planted.diameter.push_back(0.05);
  planted.axis.push_back(99);
  planted.kind.push_back(Kind::root);
  assign_orders(planted);
  const Metrics with_root = measure(planted);
  CHECK(with_root.internodes == whole.internodes + 1);
  CHECK(with_root.total_length == near(whole.total_length + 5.0));
  CHECK(*with_root.height == near(*whole.height));
  CHECK(*with_root.crown_radius == near(*whole.crown_radius));
  CHECK(*with_root.strahler_order == *whole.strahler_order);
  CHECK(*with_root.lean > *whole.lean);
}

TEST_CASE("metrics: a tree twice as large has lengths twice as large and the same pure numbers") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Skeleton one = living(random_tree(seed, 400));
    Skeleton two = one;
    for (Vec3& position : two.position) position *= 2.0;
    for (double& diameter : two.diameter) diameter *= 2.0;
    const Metrics a = measure(one);
    const Metrics b = measure(two);
    for (const MetricInfo& info : metric_table()) {
      INFO(info.key);
      const std::optional<double> x = info.value(a);
      const std::optional<double> y = info.value(b);
      REQUIRE(x.has_value() == y.has_value());
      if (!x || info.key == "dbh") continue;
      const double factor = info.unit == "m" ? 2.0 : info.unit == "m2" ? 4.0 : info.unit == "m3" ? 8.0 : 1.0;
      CHECK(*y == Approx(factor * *x).epsilon(1e-6));
    }
  }
}

TEST_CASE("metrics: a turn about the vertical changes nothing but the boxes") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Skeleton one = living(random_tree(seed, 400));
    Skeleton turned = one;
    for (Vec3& position : turned.position) position = rotated(position, kUp, 1.0) + Vec3(10, 20, 30);
    const Metrics a = measure(one);
    const Metrics b = measure(turned);
    for (const MetricInfo& info : metric_table()) {
      INFO(info.key);
      const double tolerance = info.key == "fractal_dimension" ? 0.05 : 1e-6;
      REQUIRE(info.value(a).has_value());
      CHECK(*info.value(b) == Approx(*info.value(a)).epsilon(tolerance));
    }
  }
}

TEST_CASE("metrics: orders add up to the tree") {
  const Metrics m = measure(random_tree(3, 1000));
  double length = 0.0;
  double volume = 0.0;
  std::size_t axes = 0;
  for (const OrderMetrics& own : m.by_order) {
    length += own.length;
    volume += own.volume;
    axes += own.axes;
  }
  CHECK(length == near(m.total_length));
  CHECK(volume == near(m.wood_volume));
  CHECK(axes == m.axes);
}

TEST_CASE("anatomy: children, axes and tips of every tree are what their definition says") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Skeleton s = random_tree(seed, 300);
    const Anatomy anatomy(s);
    CHECK(anatomy.axis_count() == s.axis_count());
    std::size_t in_axes = 0;
    for (std::size_t axis = 0; axis < anatomy.axis_count(); ++axis) {
      const auto nodes = anatomy.axis(axis);
      in_axes += nodes.size();
      CHECK(anatomy.is_founder(nodes.front()));
      for (std::size_t i = 1; i < nodes.size(); ++i) CHECK(s.parent[nodes[i]] == nodes[i - 1]);
      for (const std::uint32_t node : nodes) CHECK(anatomy.axis_of(node) == axis);
    }
    CHECK(in_axes == s.internode_count());
    std::size_t tips = 0;
    for (std::size_t node = s.root_count(); node < s.node_count(); ++node) {
      for (const std::uint32_t child : anatomy.children(node)) CHECK(s.parent[child] == node);
      tips += anatomy.children(node).empty() ? 1 : 0;
    }
    CHECK(tips == anatomy.tips().size());
  }
}

TEST_CASE("statistics: quantiles, deviations and slopes") {
  CHECK(*quantile({4, 1, 3, 2}, 0.5) == near(2.5));
  CHECK(*quantile({4, 1, 3, 2}, 0.95) == near(3.85));
  CHECK(*quantile({4, 1, 3, 2}, 1.0) == near(4.0));
  CHECK(*quantile({7}, 0.95) == near(7.0));
  CHECK_FALSE(quantile({}, 0.5));
  CHECK(*standard_deviation(std::vector<double>{1, 3}) == near(std::sqrt(2.0)));
  CHECK_FALSE(standard_deviation(std::vector<double>{1}));
  CHECK(*regression_slope(std::vector<double>{0, 1, 2}, std::vector<double>{5, 7, 9}) == near(2.0));
  CHECK_FALSE(regression_slope(std::vector<double>{1, 1}, std::vector<double>{5, 7}));
}
