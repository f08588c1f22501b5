#include "common/mesh/point_marks.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "common/base/lanes3.h"
#include "common/mesh/axes.h"

namespace ramify {
namespace {

// Lengths are compared as squares and turns by cosines, without roots and divisions. What is on the verge, by
// so much, is marked.
constexpr float kVerge = 1.0001f;

// The square of a turn's cosine, as kTurnMax is compared in rings_in_bend().
constexpr float kTurnCosine2 = (1.0f - 0.5f * kTurnMax * kTurnMax) * (1.0f - 0.5f * kTurnMax * kTurnMax);

/// Four points in a row, with the stretches that lead to them.
struct Points {
  Lanes3 position;
  Lanes radius;
  Lanes3 step;  // from the point before
  Lanes length2;
};

/// The last lane of `before` and the first three of `at`.
Lanes3 shifted_up(const Lanes3& before, const Lanes3& at) {
  const auto shifted = [](const Lanes& a, const Lanes& b) {
    return __builtin_shufflevector(a, b, 3, 4, 5, 6);
  };
  return {shifted(before.x, at.x), shifted(before.y, at.y), shifted(before.z, at.z)};
}

/// The last three lanes of `at` and the first one of `after`.
Lanes shifted_down(const Lanes& at, const Lanes& after) {
  return __builtin_shufflevector(at, after, 1, 2, 3, 4);
}
Lanes3 shifted_down(const Lanes3& at, const Lanes3& after) {
  return {shifted_down(at.x, after.x), shifted_down(at.y, after.y), shifted_down(at.z, after.z)};
}

/// Beyond the last point that one is repeated.
Points load(std::span<const AxisPoint> points, std::size_t first, const Lanes3& before) {
  static_assert(offsetof(AxisPoint, radius) == sizeof(Vec3f));
  const auto of = [&](std::size_t lane) {
    return load_lanes(&points[std::min(first + lane, points.size() - 1)].position.x);
  };
  const auto [x, y, z, radius] = transposed(of(0), of(1), of(2), of(3));
  Points at;
  at.position = {x, y, z};
  at.radius = radius;
  at.step = at.position - shifted_up(before, at.position);
  at.length2 = dot(at.step, at.step);
  return at;
}

LaneMask marks_of(const Points& at, const Points& after, float thinnest, float ground) {
  const Lanes spacing = 2.0f * kLeastSpacing * at.radius;
  const Lanes least = spacing < thinnest ? all_lanes(thinnest) : spacing;
  const LaneMask is_crowded = at.length2 < kVerge * least * least;
  const Lanes cosine = dot(at.step, shifted_down(at.step, after.step));
  const Lanes lengths2 = at.length2 * shifted_down(at.length2, after.length2);
  const LaneMask runs_on = (cosine > 0.0f) & (cosine * cosine > kVerge * kTurnCosine2 * lengths2);
  const LaneMask turns_back = (cosine < 0.0f) & (cosine * cosine > kSharp * kSharp * lengths2);
  const LaneMask is_low = at.position.y - kTipLength * at.radius < ground;
  const auto marked = [](const LaneMask& where, PointMark mark) { return where & std::int32_t{mark}; };
  return marked(is_crowded, kIsCrowded) | marked(~runs_on, kBends) | marked(turns_back, kTurnsBack) |
         marked(is_low, kIsLow);
}

/// Takes all points for those of a single axis.
void mark_row(std::span<const AxisPoint> points, const Axes& axes, std::uint8_t* marks) {
  using LaneBytes [[gnu::vector_size(kLanes)]] = std::uint8_t;
  const Vec3f& first = points[0].position;
  Points at;
  at.position = {all_lanes(first.x), all_lanes(first.y), all_lanes(first.z)};
  for (std::size_t next = 0; next < points.size() + kLanes; next += kLanes) {
    const Points after = load(points, next, at.position);
    if (next > 0) {
      const LaneBytes bytes =
          __builtin_convertvector(marks_of(at, after, axes.thinnest, axes.highest_ground), LaneBytes);
      const std::size_t i = next - kLanes;
      if (points.size() - i < kLanes) {
        std::memcpy(marks + i, &bytes, points.size() - i);
      } else {
        std::memcpy(marks + i, &bytes, kLanes);
      }
    }
    at = after;
  }
}

bool is_near(const Axis& axis, const Vec3f& base, const Vec3f& first) {
  const float distance = std::max(axis.bearer_radius + kClear * axis.radius, kNear * axis.bearer_radius);
  const Vec3f step = first - base;
  return glm::dot(step, step) < kVerge * distance * distance;
}

}  // namespace

void resize_marks(Axes& axes) {
  axes.marks.resize(axes.points.size() + kMarksBehind);
  std::fill_n(axes.marks.end() - kMarksBehind, kMarksBehind, std::uint8_t{0});
}

void mark_points(Axes& axes, std::size_t begin, std::size_t end) {
  if (begin == end) return;
  const std::uint32_t first = axes.list[begin].first;
  const std::uint32_t count = axes.list[end - 1].end() - first;
  if (count == 0) return;
  mark_row(std::span(axes.points).subspan(first, count), axes, &axes.marks[first]);
  for (std::size_t i = begin; i < end; ++i) {
    const Axis& axis = axes.list[i];
    if (axis.count == 0) continue;
    std::uint8_t* marks = &axes.marks[axis.first];
    marks[0] &= kIsLow;
    marks[axis.count - 1] &= kIsLow | kIsCrowded;
    if (is_near(axis, axes.points[axis.first].position, axes.points[axis.first + 1].position))
      marks[1] |= kIsNear;
  }
}

}  // namespace ramify
