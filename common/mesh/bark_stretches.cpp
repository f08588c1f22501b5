#include "common/mesh/bark_stretches.h"

#include <algorithm>
#include <cmath>

namespace ramify {
namespace {

// Stretches of an axis are at least so long, in radii: the planes between shorter ones would meet within
// thick wood that bends.
constexpr float kLeastStretch = 2.0f;

// A point is so many stretches from the one of its internode at the most.
constexpr int kStretchesAway = 8;

}  // namespace

BarkStretches::BarkStretches(const Skeleton& skeleton) : of_internode_(skeleton.node_count(), 0) {
  const Axes axes = find_axes(skeleton);
  for (const Axis& axis : axes.list) {
    const auto first = static_cast<std::uint32_t>(list_.size());
    if (axis.is_trunk()) of_internode_[axes.points[axis.first].node] = first;
    add(axes, axis);
  }
}

void BarkStretches::add(const Axes& axes, const Axis& axis) {
  const std::size_t first = list_.size();
  std::uint32_t base = axis.first;
  for (std::uint32_t point = axis.first + 1; point < axis.end(); ++point) {
    const AxisPoint& from = axes.points[base];
    const AxisPoint& to = axes.points[point];
    of_internode_[to.node] = static_cast<std::uint32_t>(list_.size());
    const float length = glm::distance(from.position, to.position);
    const bool is_tip = point + 1 == axis.end();
    if (length < kLeastStretch * std::max(from.radius, to.radius) && !is_tip) continue;
    add(from, to, list_.size() > first);
    base = point;
  }
}

void BarkStretches::add(const AxisPoint& from, const AxisPoint& to, bool goes_on) {
  Stretch stretch{.base = Vec3(from.position), .tip = Vec3(to.position)};
  stretch.along = normalized_or(stretch.tip - stretch.base, goes_on ? list_.back().along : kUp, 1e-12);
  stretch.base_plane = stretch.tip_plane = stretch.along;
  stretch.side = any_perpendicular(stretch.along);
  if (goes_on) {
    Stretch& below = list_.back();
    stretch.side = transported(below.side, below.along, stretch.along);
    stretch.start = below.end;
    stretch.base_plane = below.tip_plane = normalized_or(below.along + stretch.along, stretch.along);
    stretch.is_first = below.is_last = false;
  }
  const double girth = std::numbers::pi * (double{from.radius} + double{to.radius});
  stretch.end = stretch.start + glm::length(stretch.tip - stretch.base) / girth;
  list_.push_back(stretch);
}

Vec2f BarkStretches::uv(std::uint32_t internode, const Vec3& at) const {
  const Stretch& stretch = stretch_at(at, of_internode_[internode]);
  const Vec3 from_base = at - stretch.base;
  const double angle = std::atan2(glm::dot(from_base, glm::cross(stretch.along, stretch.side)),
                                  glm::dot(from_base, stretch.side));
  double before = glm::dot(from_base, stretch.base_plane);
  double after = glm::dot(stretch.tip - at, stretch.tip_plane);
  // On the inner side of a sharp bend the planes meet: there the place along the line decides.
  if ((before < 0.0 && !stretch.is_first) || (after < 0.0 && !stretch.is_last)) {
    before = glm::dot(from_base, stretch.along);
    after = glm::dot(stretch.tip - at, stretch.along);
  }
  const double whole = before + after;
  const double share = whole > 1e-12 ? before / whole : 0.5;
  return {static_cast<float>(angle / (2.0 * std::numbers::pi)),
          static_cast<float>(stretch.start + share * (stretch.end - stretch.start))};
}

const BarkStretches::Stretch& BarkStretches::stretch_at(const Vec3& at, std::size_t index) const {
  int direction = 0;
  for (int step = 0; step < kStretchesAway; ++step) {
    const Stretch& stretch = list_[index];
    const bool is_before = !stretch.is_first && glm::dot(at - stretch.base, stretch.base_plane) < 0.0;
    const bool is_after = !stretch.is_last && glm::dot(stretch.tip - at, stretch.tip_plane) < 0.0;
    if (is_before == is_after || direction == (is_before ? 1 : -1)) break;
    direction = is_before ? -1 : 1;
    index = is_before ? index - 1 : index + 1;
  }
  return list_[index];
}

}  // namespace ramify
