#include "common/mesh/axes.h"

#include <algorithm>

#include "common/base/parallel.h"
#include "common/mesh/wood.h"

namespace ramify {
namespace {

constexpr std::size_t kGrain = 4096;

/// Where a node stands: on which axis, and after how many of its points. Roots stand on their trunks.
struct Place {
  std::uint32_t axis = kNoParent;
  std::uint32_t rank = 0;
};

/// Lists the axes, `base` being a node as yet and `first` unset. Returns the places of all nodes.
BulkVector<Place> list_axes(const Skeleton& skeleton, BulkVector<Axis>& axes) {
  const std::size_t roots = skeleton.root_count();
  BulkVector<Place> places(roots);
  places.resize(skeleton.node_count());
  axes.reserve(skeleton.internode_count());
  for (std::size_t node = roots; node < places.size(); ++node) {
    const std::uint32_t parent = skeleton.parent[node];
    const bool is_of_parents = skeleton.axis[node] == skeleton.axis[parent];
    if (is_of_parents && parent >= roots) {
      places[node] = {places[parent].axis, places[parent].rank + 1};
      axes[places[node].axis].count = places[node].rank + 1;
      continue;
    }
    places[node] = {static_cast<std::uint32_t>(axes.size()), 1};
    if (is_of_parents) places[parent].axis = places[node].axis;
    axes.push_back({.count = 2, .base = parent});
  }
  return places;
}

}  // namespace

Axes find_axes(const Skeleton& skeleton) {
  Axes axes;
  axes.thinnest = static_cast<float>(thinnest_radius(skeleton));
  const auto radius = [&](double diameter) {
    return std::max(0.5f * static_cast<float>(diameter), axes.thinnest);
  };
  axes.thickest = radius(*std::max_element(skeleton.diameter.begin(), skeleton.diameter.end()));
  const BulkVector<Place> places = list_axes(skeleton, axes.list);
  std::uint32_t count = 0;
  for (Axis& axis : axes.list) {
    axis.first = count;
    count += axis.count;
  }
  axes.points.resize(count);
  const auto point_at = [&](std::size_t node) {
    return AxisPoint{.position = Vec3f(skeleton.position[node]),
                     .radius = radius(skeleton.diameter[node]),
                     .node = static_cast<std::uint32_t>(node)};
  };
  const std::size_t roots = skeleton.root_count();
  parallel_for(skeleton.internode_count(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t node = roots + begin; node < roots + end; ++node) {
      const auto [axis, rank] = places[node];
      axes.points[axes.list[axis].first + rank] = point_at(node);
    }
  });
  parallel_for(axes.list.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Axis& axis = axes.list[i];
      const auto [bearer, rank] = places[axis.base];
      AxisPoint& base = axes.points[axis.first];
      base = point_at(axis.base);
      axis.bearer_radius = base.radius;
      if (bearer == kNoParent || bearer == i) {
        axis.base = axis.first;
        continue;
      }
      base.radius = axes.points[axis.first + 1].radius;
      axis.base = axes.list[bearer].first + rank;
      axis.bearer = bearer;
    }
  });
  return axes;
}

}  // namespace ramify
