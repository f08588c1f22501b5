#include "common/mesh/axes.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <mutex>
#include <utility>

#include "common/base/lanes.h"
#include "common/base/parallel.h"
#include "common/mesh/point_marks.h"
#include "common/mesh/wood.h"

namespace ramify {
namespace {

constexpr std::size_t kGrain = 4096;

// A lateral that leaves its bearer's last node goes on as a part of that if it has this share of its width:
// the bearer's tip would show at the elbow.
constexpr double kGoesOn = 0.7;

/// How an axis begins.
struct Beginning {
  std::uint32_t node;    // its first
  std::uint32_t bearer;  // axis that it grows from; not yet known of all at roots
  std::uint32_t point;   // of that axis: 0 at a root, and only there
};

/// Which axis each node belongs to and where on it: roots stand at the first point of their trunks.
struct Places {
  BulkVector<std::uint32_t> axis;   // of each node
  BulkVector<std::uint32_t> point;  // of each node, counted from its axis's first

  BulkVector<Beginning> beginnings;  // of each axis
  BulkVector<std::uint32_t> count;   // of each axis, points

  std::vector<std::uint32_t> at_roots;  // axes
};

/// Numbers axes by their first nodes. Without a branch on whether a node founds one, which nobody foresees.
Places find_places(const Skeleton& skeleton) {
  const std::size_t nodes = skeleton.node_count();
  const auto roots = static_cast<std::uint32_t>(skeleton.root_count());
  Places places;
  places.axis.resize(nodes);
  places.point.resize(nodes);
  places.beginnings.resize(nodes);  // one more than there are axes is written to
  places.count.resize(nodes);
  std::fill_n(places.axis.begin(), roots, kNoParent);
  std::fill_n(places.point.begin(), roots, 0);
  std::uint32_t axes = 0;
  for (std::uint32_t node = roots; node < nodes; ++node) {
    const std::uint32_t parent = skeleton.parent[node];
    const bool is_of_parents = skeleton.axis[node] == skeleton.axis[parent];
    if (parent < roots) {
      places.at_roots.push_back(axes);
      if (is_of_parents) places.axis[parent] = axes;
    }
    const bool goes_on = is_of_parents && parent >= roots;
    const std::uint32_t bearer = places.axis[parent];
    const std::uint32_t base = places.point[parent];
    places.beginnings[axes] = {node, bearer, base};
    const std::uint32_t axis = goes_on ? bearer : axes;
    const std::uint32_t point = goes_on ? base + 1 : 1;
    axes += goes_on ? 0 : 1;
    places.axis[node] = axis;
    places.point[node] = point;
    places.count[axis] = point + 1;
  }
  places.beginnings.resize(axes);
  places.count.resize(axes);
  return places;
}

/// An axis that goes on as a part of another.
struct Continuation {
  std::uint32_t axis;
  std::uint32_t whole;   // that other
  std::uint32_t offset;  // of its first point from that one's
};

/// Lets axes go on as parts of those whose ends they leave: of their own they have no points then, and what
/// grows from them grows from the whole. In ascending order.
std::vector<Continuation> join_ends(const Skeleton& skeleton, Places& places) {
  std::vector<Continuation> continuations;
  for (std::uint32_t i = 0; i < places.count.size(); ++i) {
    auto& [node, bearer, point] = places.beginnings[i];
    if (point == 0) continue;
    if (places.count[bearer] == 0) {
      const auto part = std::ranges::lower_bound(continuations, bearer, {}, &Continuation::axis);
      bearer = part->whole;
      point += part->offset;
    }
    if (point + 1 != places.count[bearer]) continue;
    if (skeleton.diameter[node] < kGoesOn * skeleton.diameter[skeleton.parent[node]]) continue;
    continuations.push_back({i, bearer, point});
    places.count[bearer] += std::exchange(places.count[i], 0) - 1;
  }
  return continuations;
}

/// What is met on the way along all nodes: a way of its own would read them once more. Of position and
/// radius, metres.
struct Extremes {
  Lanes magnitude = all_lanes(0.0f);  // greatest
  Lanes least = all_lanes(std::numeric_limits<float>::infinity());

  void include(const Lanes& point) { include({.magnitude = ramify::magnitude(point), .least = point}); }
  void include(const Extremes& other) {
    magnitude = magnitude > other.magnitude ? magnitude : other.magnitude;
    least = least < other.least ? least : other.least;
  }
};

/// A node's position and radius, the first four numbers of an AxisPoint.
Lanes place_of(const Skeleton& skeleton, std::size_t node) {
  const Vec3f position(skeleton.position[node]);
  return Lanes{position.x, position.y, position.z, 0.5f * static_cast<float>(skeleton.diameter[node])};
}

void set_point(const Lanes& place, std::size_t node, AxisPoint& point) {
  static_assert(offsetof(AxisPoint, radius) == sizeof(Vec3f));
  store(place, &point.position.x);
  point.node = static_cast<std::uint32_t>(node);
}

/// Writes the points of all internodes. `first` has where the first point of each axis stands, or would if it
/// had one.
Extremes lay_points(const Skeleton& skeleton, const Places& places, const BulkVector<std::uint32_t>& first,
                    BulkVector<AxisPoint>& points) {
  Extremes all;
  const std::size_t roots = skeleton.root_count();
  for (std::size_t root = 0; root < roots; ++root) all.include(place_of(skeleton, root));
  std::mutex of_all;
  parallel_for(skeleton.internode_count(), kGrain, [&](std::size_t begin, std::size_t end) {
    Extremes here;
    for (std::size_t node = roots + begin; node < roots + end; ++node) {
      const Lanes place = place_of(skeleton, node);
      here.include(place);
      set_point(place, node, points[first[places.axis[node]] + places.point[node]]);
    }
    const std::lock_guard lock(of_all);
    all.include(here);
  });
  return all;
}

/// Writes an axis and its first point, if it has any. `first`: where the rows of axes begin.
void lay_axis(const Skeleton& skeleton, const Places& places, const BulkVector<std::uint32_t>& first,
              std::size_t i, Axes& axes) {
  const Beginning& beginning = places.beginnings[i];
  std::uint32_t bearer = beginning.bearer;
  if (beginning.point == 0) bearer = places.axis[skeleton.parent[beginning.node]];
  const bool is_trunk = bearer == kNoParent || bearer == i;
  Axis& axis = axes.list[i];
  axis.first = first[i];
  axis.count = places.count[i];
  axis.base = is_trunk ? first[i] : first[bearer] + beginning.point;
  axis.bearer = is_trunk ? kNoParent : bearer;
  if (axis.count == 0) {
    axis.bearer_radius = axis.radius = axes.points[axis.base].radius;
    return;
  }
  AxisPoint& base = axes.points[axis.first];
  if (beginning.point == 0) {
    const std::uint32_t root = skeleton.parent[beginning.node];
    set_point(place_of(skeleton, root), root, base);
    base.radius = std::max(base.radius, axes.thinnest);
  } else {
    base = axes.points[axis.base];
  }
  axis.bearer_radius = base.radius;
  axis.radius = axes.points[axis.first + 1].radius;
  if (!is_trunk) base.radius = axis.radius;
}

float highest_root(const Skeleton& skeleton) {
  float highest = -std::numeric_limits<float>::infinity();
  for (std::size_t root = 0; root < skeleton.root_count(); ++root)
    highest = std::max(highest, static_cast<float>(skeleton.position[root].y));
  return highest;
}

}  // namespace

Axes find_axes(const Skeleton& skeleton) {
  Places places = find_places(skeleton);
  const std::vector<Continuation> continuations = join_ends(skeleton, places);
  Axes axes;
  axes.at_roots = std::move(places.at_roots);
  axes.list.resize(places.count.size());
  BulkVector<std::uint32_t> first(places.count.size());
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    first[i] = count;
    count += places.count[i];
  }
  axes.points.resize(count);
  // While points are laid, continuations begin within the rows of their wholes; else between rows.
  std::vector<std::uint32_t> rows;
  for (const auto& [axis, whole, offset] : continuations)
    rows.push_back(std::exchange(first[axis], first[whole] + offset));
  const Extremes extremes = lay_points(skeleton, places, first, axes.points);
  for (std::size_t i = 0; i < rows.size(); ++i) first[continuations[i].axis] = rows[i];
  const Lanes& greatest = extremes.magnitude;
  axes.thinnest = static_cast<float>(thinnest_radius(std::max({greatest[0], greatest[1], greatest[2]})));
  const auto widened = [&](AxisPoint point) {
    point.radius = std::max(point.radius, axes.thinnest);
    return point;
  };
  axes.thickest = std::max(greatest[3], axes.thinnest);
  if (extremes.least[3] < axes.thinnest) std::ranges::transform(axes.points, axes.points.begin(), widened);
  axes.highest_ground = highest_root(skeleton);
  resize_marks(axes);
  parallel_for(axes.list.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) lay_axis(skeleton, places, first, i, axes);
    mark_points(axes, begin, end);
  });
  return axes;
}

}  // namespace ramify
