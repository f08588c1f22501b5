#include "common/mesh/sharp_turns.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "common/base/parallel.h"
#include "common/mesh/point_marks.h"

namespace ramify {
namespace {

constexpr std::size_t kGrain = 4096;

/// The points at which axes turn sharply, in ascending order. Few do: eight marks are looked at at a time.
std::vector<std::uint32_t> sharp_points(const Axes& axes) {
  constexpr std::uint64_t any = kTurnsBack * std::uint64_t{0x0101010101010101};
  const auto count = static_cast<std::uint32_t>(axes.points.size());
  std::vector<std::uint32_t> points;
  for (std::uint32_t first = 0; first < count; first += sizeof any) {
    static_assert(sizeof any <= kMarksBehind + 1);
    std::uint64_t marks;
    std::memcpy(&marks, &axes.marks[first], sizeof marks);
    if ((marks & any) == 0) continue;
    const std::uint32_t end = std::min<std::uint32_t>(first + sizeof any, count);
    for (std::uint32_t point = first; point < end; ++point) {
      if ((axes.marks[point] & kTurnsBack) != 0) points.push_back(point);
    }
  }
  return points;
}

}  // namespace

void part_sharp_turns(Axes& axes) {
  const std::vector<std::uint32_t> turns = sharp_points(axes);
  if (turns.empty()) return;

  // Each turn adds an axis and, as that begins where the one before ends, a point.
  const auto turns_before = [&](std::uint32_t point) {
    return static_cast<std::uint32_t>(std::lower_bound(turns.begin(), turns.end(), point) - turns.begin());
  };
  BulkVector<Axis> list;
  BulkVector<AxisPoint> points;
  list.reserve(axes.list.size() + turns.size());
  points.reserve(axes.points.size() + turns.size());
  for (const Axis& whole : axes.list) {
    Axis axis = whole;
    axis.first = static_cast<std::uint32_t>(points.size());
    axis.base += turns_before(whole.base);
    if (!whole.is_trunk()) axis.bearer += turns_before(whole.base);
    auto turn = std::lower_bound(turns.begin(), turns.end(), whole.first);
    for (std::uint32_t point = whole.first; point < whole.end(); ++point) {
      points.push_back(axes.points[point]);
      if (turn == turns.end() || *turn != point) continue;
      ++turn;
      const auto end = static_cast<std::uint32_t>(points.size());
      axis.count = end - axis.first;
      list.push_back(axis);
      const AxisPoint& base = axes.points[point];
      axis = {.first = end,
              .count = 0,
              .base = end - 1,
              .bearer = static_cast<std::uint32_t>(list.size() - 1),
              .bearer_radius = base.radius,
              .radius = axes.points[point + 1].radius};
      points.push_back(base);
      points.back().radius = axis.radius;
    }
    axis.count = static_cast<std::uint32_t>(points.size()) - axis.first;
    list.push_back(axis);
  }
  for (std::uint32_t& axis : axes.at_roots) axis += turns_before(axes.list[axis].first);
  axes.list = std::move(list);
  axes.points = std::move(points);
  resize_marks(axes);
  parallel_for(axes.list.size(), kGrain,
               [&](std::size_t begin, std::size_t end) { mark_points(axes, begin, end); });
}

}  // namespace ramify
