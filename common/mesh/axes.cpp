#include "common/mesh/axes.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <mutex>

#include "common/base/lanes.h"
#include "common/base/parallel.h"
#include "common/mesh/point_marks.h"
#include "common/mesh/wood.h"

namespace ramify {
namespace {

constexpr std::size_t kGrain = 4096;

/// Which axis each node belongs to and where on it: roots stand at the first point of their trunks.
struct Places {
  BulkVector<std::uint32_t> axis;   // of each node
  BulkVector<std::uint32_t> point;  // of each node, counted from its axis's first

  BulkVector<std::uint32_t> base;   // of each axis: the node that it grows from
  BulkVector<std::uint32_t> count;  // of each axis, points

  std::vector<std::uint32_t> at_roots;  // axes
};

/// Numbers axes by their first nodes. Without a branch on whether a node founds one, which nobody foresees.
Places find_places(const Skeleton& skeleton) {
  const std::size_t nodes = skeleton.node_count();
  const auto roots = static_cast<std::uint32_t>(skeleton.root_count());
  Places places;
  places.axis.resize(nodes);
  places.point.resize(nodes);
  places.base.resize(nodes);  // one more than there are axes is written to
  places.count.resize(nodes);
  std::fill_n(places.axis.begin(), roots, kNoParent);
  std::fill_n(places.point.begin(), roots, 0);
  std::uint32_t axes = 0;
  for (std::size_t node = roots; node < nodes; ++node) {
    const std::uint32_t parent = skeleton.parent[node];
    const bool is_of_parents = skeleton.axis[node] == skeleton.axis[parent];
    if (parent < roots) {
      places.at_roots.push_back(axes);
      if (is_of_parents) places.axis[parent] = axes;
    }
    const bool goes_on = is_of_parents && parent >= roots;
    places.base[axes] = parent;
    const std::uint32_t axis = goes_on ? places.axis[parent] : axes;
    const std::uint32_t point = goes_on ? places.point[parent] + 1 : 1;
    axes += goes_on ? 0 : 1;
    places.axis[node] = axis;
    places.point[node] = point;
    places.count[axis] = point + 1;
  }
  places.base.resize(axes);
  places.count.resize(axes);
  return places;
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

/// Writes the points of all internodes, and counts those of `places` from the first of all axes. `first` has
/// one an axis.
Extremes lay_points(const Skeleton& skeleton, const BulkVector<std::uint32_t>& first, Places& places,
                    BulkVector<AxisPoint>& points) {
  Extremes all;
  const std::size_t roots = skeleton.root_count();
  for (std::size_t root = 0; root < roots; ++root) {
    all.include(place_of(skeleton, root));
    if (places.axis[root] != kNoParent) places.point[root] = first[places.axis[root]];
  }
  std::mutex of_all;
  parallel_for(skeleton.internode_count(), kGrain, [&](std::size_t begin, std::size_t end) {
    Extremes here;
    for (std::size_t node = roots + begin; node < roots + end; ++node) {
      const Lanes place = place_of(skeleton, node);
      here.include(place);
      places.point[node] += first[places.axis[node]];
      set_point(place, node, points[places.point[node]]);
    }
    const std::lock_guard lock(of_all);
    all.include(here);
  });
  return all;
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
  const Extremes extremes = lay_points(skeleton, first, places, axes.points);
  const Lanes& greatest = extremes.magnitude;
  axes.thinnest = static_cast<float>(thinnest_radius(std::max({greatest[0], greatest[1], greatest[2]})));
  const auto widened = [&](AxisPoint point) {
    point.radius = std::max(point.radius, axes.thinnest);
    return point;
  };
  axes.thickest = std::max(greatest[3], axes.thinnest);
  if (extremes.least[3] < axes.thinnest) std::ranges::transform(axes.points, axes.points.begin(), widened);
  axes.highest_ground = highest_root(skeleton);
  const std::size_t roots = skeleton.root_count();
  resize_marks(axes);
  parallel_for(axes.list.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t node = places.base[i];
      const std::uint32_t bearer = places.axis[node];
      const bool is_trunk = bearer == kNoParent || bearer == i;
      Axis& axis = axes.list[i];
      axis.first = first[i];
      axis.count = places.count[i];
      axis.base = is_trunk ? first[i] : places.point[node];
      axis.bearer = is_trunk ? kNoParent : bearer;
      AxisPoint& base = axes.points[axis.first];
      if (node < roots) {
        set_point(place_of(skeleton, node), node, base);
        base.radius = std::max(base.radius, axes.thinnest);
      } else {
        base = axes.points[axis.base];
      }
      axis.bearer_radius = base.radius;
      axis.radius = axes.points[axis.first + 1].radius;
      if (!is_trunk) base.radius = axis.radius;
    }
    mark_points(axes, begin, end);
  });
  return axes;
}

}  // namespace ramify
