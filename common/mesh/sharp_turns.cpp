#include "common/mesh/sharp_turns.h"

#include <algorithm>
#include <vector>

#include "common/base/parallel.h"

namespace ramify {
namespace {

// Cosine beyond which a turn is sharp: rings in it would lean too much to both sides, and arcs have seldom
// room.
constexpr float kSharp = -0.5f;

constexpr std::size_t kGrain = 4096;

bool is_sharp(const AxisPoint& before, const AxisPoint& at, const AxisPoint& after) {
  const Vec3f in = at.position - before.position;
  const Vec3f out = after.position - at.position;
  const float cosine = glm::dot(in, out);
  // Few turn by more than a right angle at all.
  return cosine < 0.0f && cosine * cosine > kSharp * kSharp * glm::dot(in, in) * glm::dot(out, out);
}

/// The points at which axes turn sharply, in ascending order.
std::vector<std::uint32_t> sharp_points(const Axes& axes) {
  std::vector<std::vector<std::uint32_t>> found((axes.list.size() + kGrain - 1) / kGrain);
  parallel_for(found.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t part = begin; part < end; ++part) {
      const std::size_t last = std::min((part + 1) * kGrain, axes.list.size());
      for (std::size_t i = part * kGrain; i < last; ++i) {
        for (std::uint32_t p = axes.list[i].first + 1; p + 1 < axes.list[i].end(); ++p) {
          if (is_sharp(axes.points[p - 1], axes.points[p], axes.points[p + 1])) found[part].push_back(p);
        }
      }
    }
  });
  std::vector<std::uint32_t> result;
  for (const auto& points : found) result.insert(result.end(), points.begin(), points.end());
  return result;
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
              .bearer_radius = base.radius};
      points.push_back(base);
      points.back().radius = axes.points[point + 1].radius;
    }
    axis.count = static_cast<std::uint32_t>(points.size()) - axis.first;
    list.push_back(axis);
  }
  for (std::uint32_t& axis : axes.at_roots) axis += turns_before(axes.list[axis].first);
  axes.list = std::move(list);
  axes.points = std::move(points);
}

}  // namespace ramify
