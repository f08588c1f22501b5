#include "common/mesh/tube_plan.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <utility>

#include "common/base/parallel.h"
#include "common/mesh/detail.h"
#include "common/mesh/wood.h"

namespace ramify {
namespace {

// A straightened line looks back at no more knots than these.
constexpr std::size_t kLookBack = 64;

// A trunk that leans more than this, as a cosine, has no foot that stands on the ground.
constexpr float kLeastUpright = 0.5f;

// In radii: so far up a foot without a flare turns from the ground's direction to its trunk's.
constexpr float kFootHeight = 1.0f;

// A collar knows so many of its parent's knots on either side.
constexpr int kKnotsAside = 4;

// A collar begins by so much inside the facets of the parent.
constexpr double kWithinFacets = 0.97;

// A bearer's base lies where its own bearer's base lets it: beyond so many bearers that is not felt.
constexpr int kMovedBases = 3;

constexpr std::size_t kGrain = 256;

std::uint8_t collar_stretches(std::uint32_t sides) {
  return static_cast<std::uint8_t>(sides <= 3 ? 1 : sides <= 5 ? 2 : sides <= 8 ? 3 : 5);
}

/// Trunks that stand on the ground with a foot of their own: those without real roots. In ascending order.
std::vector<std::uint32_t> flared_trunks(const TubePlan& plan, const Skeleton& skeleton) {
  if (plan.flare <= 0.0) return {};
  const Axes& axes = *plan.axes;
  const auto first_node = [&](const Axis& axis) { return axes.points[axis.first + 1].node; };
  const auto base_node = [&](const Axis& axis) { return axes.points[axis.first].node; };
  std::vector<bool> has_roots(skeleton.root_count(), false);
  for (const std::uint32_t i : axes.at_roots) {
    const Axis& axis = axes.list[i];
    if (skeleton.kind[first_node(axis)] == Kind::root) has_roots[base_node(axis)] = true;
  }
  std::vector<std::uint32_t> flared;
  for (const std::uint32_t i : axes.at_roots) {
    const Axis& axis = axes.list[i];
    if (!axis.is_trunk()) continue;
    const std::uint32_t base = base_node(axis);
    if (skeleton.axis[first_node(axis)] == skeleton.axis[base] && !has_roots[base] &&
        plan.flare * axes.points[axis.first].radius > plan.tolerance)
      flared.push_back(i);
  }
  return flared;
}

/// Whether all knots after `from` are within `tolerance` of the straight stretch from it to `to`.
bool is_straight(std::span<const Knot> between, const Knot& from, const Knot& to, float tolerance) {
  const Vec3f step = to.position - from.position;
  const float length2 = std::max(glm::dot(step, step), 1e-24f);
  for (const Knot& knot : between) {
    const float t = std::clamp(glm::dot(knot.position - from.position, step) / length2, 0.0f, 1.0f);
    const float apart = glm::length(knot.position - (from.position + step * t)) +
                        std::abs(knot.radius - glm::mix(from.radius, to.radius, t));
    if (apart > tolerance) return false;
  }
  return true;
}

/// Leaves out knots so that the line stays within `tolerance` of the one given.
void straighten(std::vector<Knot>& knots, float tolerance) {
  std::size_t kept = 0;  // knots[kept] is the last that stays
  std::size_t from = 0;  // where it stood
  std::vector<Knot>& line = knots;
  Knot anchor = line[0];
  for (std::size_t i = 2; i <= line.size(); ++i) {
    const bool is_end = i == line.size();
    const bool goes_on =
        !is_end && i - from <= kLookBack &&
        is_straight(std::span(line).subspan(from + 1, i - from - 1), anchor, line[i], tolerance);
    if (goes_on) continue;
    from = i - 1;
    anchor = line[from];
    line[++kept] = anchor;
  }
  line.resize(kept + 1);
}

/// Lays the base of a trunk that leans into the ground's plane: its rings turn evenly up to `height`, metres.
void stand_on_ground(std::vector<LinePoint>& points, float height) {
  if (points[0].along.y < kLeastUpright) return;
  float from = 0.0f;
  for (std::size_t i = 0; i < points.size() && from < height; ++i) {
    if (i > 0) from += glm::distance(points[i].position, points[i - 1].position);
    const float share = std::min(from / height, 1.0f);
    points[i].along = normalized_or(glm::mix(Vec3f(kUp), points[i].along, share), Vec3f(kUp));
  }
  part_rings(points, 1);
}

std::size_t base_sides(const Tube& tube) {
  return tube.sides * (tube.flare_rings > 0 ? 2 : 1);
}

// A ring repeats its first vertex at the end, where u jumps from 1 to 0. The tip has a vertex a side, a
// closed base its rim once more and a center.
std::size_t vertex_count(const Tube& tube) {
  return tube.rings * (tube.sides + 1) + tube.flare_rings * tube.sides + tube.sides +
         (tube.is_closed ? base_sides(tube) + 1 : 0);
}

std::size_t triangle_count(const Tube& tube) {
  std::size_t bands = (tube.rings - 1) * 2;  // of triangles a side
  if (tube.flare_rings > 0) bands += (tube.flare_rings - 1) * 2 + 1;
  return (bands + 1) * tube.sides + (tube.is_closed ? base_sides(tube) : 0);
}

class Planner {
 public:
  /// `flared` trunks have a foot.
  Planner(TubePlan& plan, const MesherOptions& options, const std::vector<std::uint32_t>& flared)
      : plan_(plan),
        axes_(*plan.axes),
        options_(options),
        flared_(flared),
        tolerance_(static_cast<float>(plan.tolerance)),
        turn_max_(plan.tolerance > 0.0 ? 2.0f * kTurnMax : kTurnMax),
        twig_(radius_of_sides(options.sides_min + 0.499)),
        seen_(std::max(2.0f * tolerance_, kLeastCollar * axes_.thickest)) {}

  /// Chooses a tube's points, sides and rings.
  void plan(std::size_t index) {
    const Axis& axis = axes_.list[index];
    Tube& tube = plan_.tubes[index];
    tube = {};
    const std::uint16_t sides = sides_of(axis);
    tube.sides = sides;
    tube.is_closed = axis.is_trunk();
    if (is_even(axis)) {
      // Nothing is read here that has just been written in parts: that would be waited for.
      const bool has_collar = axis.radius > seen_;
      const std::uint8_t collar = has_collar ? collar_stretches(sides) : 0;
      tube.collar = collar;
      tube.rings = axis.count + collar + (sides > 3 ? 1 : 0);
      tube.is_plain = sides == 3 && !has_collar;
    } else {
      std::fill_n(&plan_.rings[axis.first + 1], axis.count - 1, 0);
      tube.has_flare = tube.is_closed && std::ranges::binary_search(flared_, index);
      choose_rings(axis, tube);
    }
    // As yet as many as there are: where they begin is known when all tubes are planned.
    tube.first_vertex = tube.rings == 0 ? 0 : vertex_count(tube);
    tube.first_triangle = tube.rings == 0 ? 0 : triangle_count(tube);
  }

  void leave_out(std::size_t index) {
    std::fill_n(&plan_.rings[axes_.list[index].first + 1], axes_.list[index].count - 1, 0);
    plan_.tubes[index] = {};
  }

 private:
  /// Whether all points of a lateral are knots with a ring each, by their marks. Nearly all laterals are
  /// even.
  bool is_even(const Axis& axis) {
    if (tolerance_ > 0.0f || plan_.line != CentreLine::polyline || axis.is_trunk()) return false;
    if (!has_marks_only(axis, kIsNear) || tapers_much(axis)) return false;
    if ((axes_.marks[axis.first + 1] & kIsNear) == 0) return true;
    knots_.clear();
    append_knot(knots_, axes_, axis.first);
    append_knot(knots_, axes_, axis.first + 1);
    return !is_buried(axis, knots_[1]);
  }

  /// Of the thick ones.
  bool tapers_much(const Axis& axis) const {
    if (tolerance_ > 0.0f || axis.radius < kThickTaper * axes_.thickest) return false;
    for (std::uint32_t point = axis.first + 2; point < axis.end(); ++point) {
      if (bands_of_taper(axes_.points[point - 1].radius, axes_.points[point].radius) > 1) return true;
    }
    return false;
  }

  /// Whether no point of an axis has another mark. Most axes have few points: these go without a loop, whose
  /// end would not be foreseen.
  bool has_marks_only(const Axis& axis, PointMark mark) const {
    static_assert(std::endian::native == std::endian::little);
    const std::uint8_t* marks = &axes_.marks[axis.first];
    std::uint64_t others;
    constexpr std::uint32_t at_once = sizeof others;
    static_assert(at_once <= kMarksBehind + 1);
    std::memcpy(&others, marks, at_once);
    others &= ~(std::uint64_t{mark} * 0x0101010101010101);
    if (axis.count < at_once) others &= (std::uint64_t{1} << 8 * axis.count) - 1;
    return others == 0 && std::all_of(marks + std::min(axis.count, at_once), marks + axis.count,
                                      [&](std::uint8_t other) { return (other & ~mark) == 0; });
  }

  /// The long way: point by point.
  void choose_rings(const Axis& axis, Tube& tube) {
    choose_knots(axis);
    if (knots_.back().length <= axes_.thinnest && knots_.size() == 2) return;  // a point
    const float radius = axis.radius;
    if (!tube.is_closed && radius > seen_ && knots_[1].length > axis.bearer_radius + 0.5f * radius) {
      tube.collar = collar_stretches(tube.sides);
      knots_[1].room *= kRoomBesideCollar;
    }
    count_rings(knots_, plan_.line, turn_max_, 0.5f * tolerance_);
    tube.tapers = tapers_much(axis);
    std::size_t rings = 1;
    for (std::size_t i = 1; i < knots_.size(); ++i) {
      const std::uint32_t bands = tube.tapers ? bands_of_taper(knots_, i) : 1;
      if (plan_.line == CentreLine::polyline) {
        rings += bands - 1;
      } else {
        knots_[i].rings = std::max(knots_[i].rings, bands);
      }
      plan_.rings[knots_[i].point] = static_cast<std::uint8_t>(knots_[i].rings);
      rings += knots_[i].rings;
    }
    tube.is_pointed = tolerance_ > 0.0f && tube.sides == 3 && knots_.back().radius < tolerance_;
    tube.has_flare = tube.has_flare && knots_[0].along.y > kLeastUpright;
    if (tube.has_flare) {
      points_.clear();
      const RootFlare flare = trace_tube(plan_, tube, knots_, points_);
      tube.flare_rings = rings_below(points_, flare.height);
      rings = points_.size();
    }
    tube.rings = static_cast<std::uint32_t>(rings) + tube.collar + (tube.has_round_tip() ? 1 : 0) -
                 (tube.is_pointed ? 1 : 0);
    tube.is_low = std::any_of(knots_.begin(), knots_.end(), [&](const Knot& knot) {
      return knot.position.y - kTipLength * knot.radius < axes_.highest_ground;
    });
    tube.is_plain = !tube.is_low && plan_.line == CentreLine::polyline && tube.sides == 3 &&
                    tube.collar == 0 && !tube.is_closed && !tube.is_pointed && knots_.size() == axis.count &&
                    rings == axis.count;
  }

  /// Where side_count() has so many sides before it rounds them.
  float radius_of_sides(double sides) const {
    const double share = sides / options_.sides_max;
    return static_cast<float>(share * share * double{axes_.thickest});
  }

  std::uint16_t sides_of(const Axis& axis) const {
    const float radius = axis.radius;
    const std::uint32_t wanted = radius < twig_ ? static_cast<std::uint32_t>(options_.sides_min)
                                                : side_count(radius, axes_.thickest, options_);
    return static_cast<std::uint16_t>(sides_within(wanted, radius, plan_.tolerance));
  }

  void choose_knots(const Axis& axis) {
    knots_.clear();
    append_knot(knots_, axes_, axis.first);
    for (std::uint32_t i = axis.first + 1; i < axis.end(); ++i) {
      append_knot(knots_, axes_, i);
      const Knot& knot = knots_.back();
      const bool is_tip = i + 1 == axis.end();
      const bool is_first = knots_.size() == 2;
      const bool is_crowded = knot.length < std::max(2.0f * kLeastSpacing * knot.radius, axes_.thinnest);
      if (is_tip) {
        if (is_crowded && !is_first) drop_last_but_one();
      } else if (is_crowded || (is_first && !axis.is_trunk() && is_buried(axis, knot))) {
        knots_.pop_back();
      }
    }
    if (tolerance_ <= 0.0f) return;
    straighten(knots_, 0.5f * tolerance_);
    measure(knots_);
  }

  void drop_last_but_one() {
    knots_[knots_.size() - 2] = knots_.back();
    knots_.pop_back();
    measure(knots_, knots_.size() - 1);
  }

  /// Whether a lateral's first knot still lies in the wood of its bearer, about which the lateral begins.
  bool is_buried(const Axis& axis, const Knot& knot) const {
    const float edge = axis.bearer_radius + kClear * knot.radius;
    if (knot.length < edge) return true;
    if (knot.length > kNear * axis.bearer_radius) return false;
    // Along the bearer after the base, or before it where it ends.
    const Axis& bearer = axes_.list[axis.bearer];
    const bool ends = axis.base + 1 == bearer.end();
    const std::uint32_t low = ends ? axis.base - 1 : axis.base;
    const Vec3f step = axes_.points[low + 1].position - axes_.points[low].position;
    const Vec3f along = normalized_or(step, Vec3f(kUp), 1e-12f);
    const float height = knot.length * glm::dot(knot.along, along);
    return !(ends && height > 0.0f) && knot.length * knot.length - height * height < edge * edge;
  }

  static std::uint8_t rings_below(const std::vector<LinePoint>& points, double height) {
    double from = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i > 0) from += glm::distance(points[i].position, points[i - 1].position);
      // The last ring keeps the trunk's own sides, and the flare's end must not miss it by rounding.
      if (from > 0.999 * height || i + 1 == points.size()) return static_cast<std::uint8_t>(i);
    }
    return 0;
  }

  TubePlan& plan_;
  const Axes& axes_;
  const MesherOptions& options_;
  const std::vector<std::uint32_t>& flared_;
  const float tolerance_;
  const float turn_max_;
  const float twig_;         // thinner wood, most of a tree, has the fewest sides
  const float seen_;         // thinner laterals have no collar
  std::vector<Knot> knots_;  // scratch, as below
  std::vector<LinePoint> points_;
};

}  // namespace

TubePlan plan_tubes(const Skeleton& skeleton, const Axes& axes, const MesherOptions& options,
                    double tolerance) {
  TubePlan plan;
  plan.axes = &axes;
  plan.line = options.centre_line;
  plan.flare = options.root_flare;
  plan.tolerance = tolerance;
  plan.tubes.resize(axes.list.size());
  plan.rings.assign(axes.points.size(), 1);
  const std::vector<std::uint32_t> flared = flared_trunks(plan, skeleton);
  const bool keeps_all = tolerance <= 0.0;
  const std::vector<bool> is_kept = kept_axes(skeleton, tolerance);
  parallel_for(plan.tubes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Planner planner(plan, options, flared);
    for (std::size_t i = begin; i < end; ++i) {
      if (axes.list[i].count == 0) {
        plan.tubes[i] = {};
      } else if (keeps_all || is_kept[axes.points[axes.list[i].first + 1].node]) {
        planner.plan(i);
      } else {
        planner.leave_out(i);
      }
    }
  });
  for (Tube& tube : plan.tubes) {
    plan.vertex_count += std::exchange(tube.first_vertex, plan.vertex_count);
    plan.triangle_count += std::exchange(tube.first_triangle, plan.triangle_count);
  }
  return plan;
}

void collect_knots(const TubePlan& plan, std::size_t tube, std::vector<Knot>& knots) {
  const Axis& axis = plan.axes->list[tube];
  knots.clear();
  append_knot(knots, *plan.axes, axis.first);
  for (std::uint32_t point = axis.first + 1; point < axis.end(); ++point) {
    if (plan.rings[point] == 0) continue;
    append_knot(knots, *plan.axes, point);
    knots.back().rings = plan.rings[point];
  }
  if (plan.tubes[tube].collar > 0) knots[1].room *= kRoomBesideCollar;
}

RootFlare trace_tube(const TubePlan& plan, const Tube& tube, const std::vector<Knot>& knots,
                     std::vector<LinePoint>& points) {
  trace_line(knots, plan.line, tube.tapers, points);
  // Twigs are most of a tree, and few have arcs.
  if (tube.sides > 3 || points.size() > knots.size()) part_rings(points, 1);
  if (tube.is_closed && !tube.has_flare) stand_on_ground(points, kFootHeight * knots[0].radius);
  if (!tube.has_flare) return {};
  double length = 0.0;
  for (const Knot& knot : knots) length += knot.length;
  const RootFlare flare = flare_of(knots[0].radius, length, plan.flare);
  add_flare_points(flare, points);
  stand_on_ground(points, static_cast<float>(flare.height));
  return flare;
}

std::pair<std::size_t, std::size_t> triangles_around(const TubePlan& plan, std::size_t tube) {
  const bool is_last = tube + 1 == plan.tubes.size();
  const std::size_t end = is_last ? plan.triangle_count : plan.tubes[tube + 1].first_triangle;
  const Tube& of = plan.tubes[tube];
  return {of.first_triangle, end - (of.is_closed ? base_sides(of) : 0)};
}

namespace {

/// `moved_bases`: for so many bearers, each the bearer of the one before, it is asked where their bases are.
Fork fork_at(const TubePlan& plan, std::size_t lateral, int moved_bases) {
  const Axes& axes = *plan.axes;
  const std::uint32_t base = axes.list[lateral].base;
  const Axis& bearer = axes.list[axes.list[lateral].bearer];
  const Tube& tube = plan.tubes[axes.list[lateral].bearer];
  const auto is_knot = [&](std::uint32_t point) { return point == bearer.first || plan.rings[point] > 0; };
  Fork fork;
  fork.inset = kWithinFacets * std::cos(std::numbers::pi / tube.sides);

  // The bearer's knots around the point: it may have been left out itself.
  std::uint32_t first = base;
  for (int left = kKnotsAside; first != bearer.first && left > 0;) left -= is_knot(--first);
  while (!is_knot(first)) --first;
  std::vector<Knot> knots;
  // Else both would grow five times for each collar.
  knots.reserve(2 * kKnotsAside + 1);
  fork.line.reserve(2 * kKnotsAside + 1);
  int beyond = 0;
  std::uint32_t point = first;
  for (; point != bearer.end() && beyond < kKnotsAside; ++point) {
    if (!is_knot(point)) continue;
    append_knot(knots, axes, point);
    if (knots.size() > 1) knots.back().rings = plan.rings[point];
    beyond += point > base;
  }
  if (first == bearer.first && tube.collar > 0 && knots.size() > 1) {
    // A collar begins on its bearer's line, which may pass by the point.
    if (moved_bases > 0 && base <= knots[1].point && plan.rings[bearer.base] != 1) {
      knots[0].position = Vec3f(fork_at(plan, axes.list[lateral].bearer, moved_bases - 1).center);
      measure(knots);
    }
    knots[1].room *= kRoomBesideCollar;
  }
  trace_line(knots, plan.line, tube.tapers, fork.line);
  fork.has_tip = point == bearer.end();

  // The place on that line.
  const Vec3 node(axes.points[base].position);
  double least = std::numeric_limits<double>::infinity();
  fork.center = Vec3(fork.line[0].position);
  fork.radius = fork.line[0].radius;
  fork.along = Vec3(fork.line[0].along);
  for (std::size_t i = 1; i < fork.line.size(); ++i) {
    const Vec3 from(fork.line[i - 1].position);
    const Vec3 step = Vec3(fork.line[i].position) - from;
    const double length2 = std::max(glm::dot(step, step), 1e-24);
    const double t = std::clamp(glm::dot(node - from, step) / length2, 0.0, 1.0);
    const double distance = glm::distance(node, from + step * t);
    if (distance >= least) continue;
    least = distance;
    fork.center = from + step * t;
    fork.radius = glm::mix(double{fork.line[i - 1].radius}, double{fork.line[i].radius}, t);
    fork.along = normalized_or(glm::mix(Vec3(fork.line[i - 1].along), Vec3(fork.line[i].along), t), kUp);
  }
  return fork;
}

}  // namespace

Fork fork_at(const TubePlan& plan, std::size_t lateral) {
  return fork_at(plan, lateral, kMovedBases);
}

}  // namespace ramify
