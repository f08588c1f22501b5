#include "common/mesh/centre_line.h"

#include <algorithm>

#include "common/mesh/wood.h"

namespace ramify {
namespace {

// Of a stretch: two neighbouring bends leave a little of it straight.
constexpr float kReachOfStretch = 0.45f;

// In radii: a bend looks grown rather than broken, and does not close on its inner side.
constexpr float kReachOfRadius = 3.0f;

// An arc takes so many times the room that its inner side needs: its rings only come near each other there.
constexpr float kRoomForArc = 1.1f;

// The same for a curve through the knots, which bends unevenly, by its mean radius.
constexpr float kRoomForCurve = 1.6f;

// Cosine beyond which a single ring in a bend would lean too much to both sides.
constexpr float kSharp = -0.2f;

// Two rings of a bend stay so many times farther apart than they must not to cross.
constexpr float kClearance = 1.02f;

// Rings that cross are turned less, down to about this share of the turn.
constexpr float kLeastTurn = 0.1f;

// A full turn takes no more than these.
constexpr float kRingsMax = 24.0f;

// Cosine beyond which a line turns back on itself: the arc then goes round sideways.
constexpr float kHairpin = -0.9f;

/// Field by field: copying a whole point would wait for its parts to be written.
void add_point(std::vector<LinePoint>& points, const Vec3f& position, const Vec3f& along, float radius,
               std::uint32_t node) {
  LinePoint& point = points.emplace_back();
  point.position = position;
  point.along = along;
  point.radius = radius;
  point.node = node;
}

/// Points of the quadratic Bezier curve with its control point at the knot: it leaves both stretches along
/// their own direction.
void round_bend(const Knot& before, const Knot& knot, const Knot& next, std::vector<LinePoint>& points) {
  const float reach = bend_reach(knot.radius, knot.room, next.room);
  const float radius_in = glm::mix(knot.radius, before.radius, reach / knot.length);
  const float radius_out = glm::mix(knot.radius, next.radius, reach / next.length);
  const bool is_hairpin = glm::dot(knot.along, next.along) < kHairpin;
  const Vec3f aside = is_hairpin ? any_perpendicular(knot.along) * reach : Vec3f(0.0f);
  for (std::uint32_t ring = 0; ring < knot.rings; ++ring) {
    const float t = static_cast<float>(ring) / static_cast<float>(knot.rings - 1);
    const float s = 1.0f - t;
    const Vec3f offset =
        knot.along * (-reach * s * s) + next.along * (reach * t * t) + aside * (4.0f * s * t);
    const Vec3f derivative = knot.along * s + next.along * t + aside * (2.0f / reach * (s - t));
    add_point(points, knot.position + offset, normalized_or(derivative, knot.along),
              radius_in * s * s + knot.radius * 2.0f * s * t + radius_out * t * t, knot.node);
  }
}

/// Parts the straight way to points[end], the first of a knot, into bands.
void part_stretch(const Knot& knot, std::uint32_t bands, std::size_t end, std::vector<LinePoint>& points) {
  const LinePoint from = points[end - 1];
  const LinePoint to = points[end];
  points.insert(points.begin() + static_cast<std::ptrdiff_t>(end), bands - 1, LinePoint{});
  for (std::uint32_t band = 1; band < bands; ++band) {
    const float t = static_cast<float>(band) / static_cast<float>(bands);
    points[end + band - 1] = {glm::mix(from.position, to.position, t), knot.along,
                              glm::mix(from.radius, to.radius, t), knot.node};
  }
}

void trace_polyline(std::span<const Knot> knots, bool parts_tapers, std::vector<LinePoint>& points) {
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const Knot& knot = knots[i];
    const std::size_t first = points.size();
    if (i + 1 == knots.size()) {
      add_point(points, knot.position, knot.along, knot.radius, knot.node);
    } else if (knot.rings > 1) {
      round_bend(knots[i - 1], knot, knots[i + 1], points);
    } else {
      add_point(points, knot.position, normalized_or(knot.along + knots[i + 1].along, knot.along),
                knot.radius, knot.node);
    }
    if (parts_tapers) part_stretch(knot, bands_of_taper(knots, i), first, points);
  }
}

/// Cubic Hermite curves with the spline's tangents; the width changes evenly.
void trace_spline(std::span<const Knot> knots, std::vector<LinePoint>& points) {
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const Vec3f from = knots[i - 1].position;
    const Vec3f to = knots[i].position;
    // The tangent is continuous by direction and speed; the speed is by the share of each stretch.
    const Vec3f start = i == 1 ? to - from
                               : spline_tangent(knots, i - 1) *
                                     std::sqrt(knots[i].length / std::max(knots[i - 1].length, 1e-12f));
    const Vec3f end = spline_tangent(knots, i);
    const float before = 1.0f - knots[i].room / std::max(knots[i].length, 1e-12f);  // a collar's share
    for (std::uint32_t ring = 1; ring <= knots[i].rings; ++ring) {
      const float s =
          (1.0f - before) * (1.0f - static_cast<float>(ring) / static_cast<float>(knots[i].rings));
      const float t = 1.0f - s;
      const Vec3f position = from * (s * s * (1.0f + 2.0f * t)) + start * (s * s * t) +
                             to * (t * t * (3.0f - 2.0f * t)) - end * (t * t * s);
      const Vec3f derivative =
          (to - from) * (6.0f * s * t) + start * (s * (s - 2.0f * t)) + end * (t * (t - 2.0f * s));
      add_point(points, position, normalized_or(derivative, knots[i].along),
                glm::mix(knots[i - 1].radius, knots[i].radius, t), knots[i].node);
    }
  }
}

/// Whether the arc at a knot curves less than the tube is thick, so that its rings do not cross on the inner
/// side: its sharpest radius is reach cos^2(turn / 2) / sin(turn / 2). In sharp bends one ring would not do.
bool has_room_for_arc(const Knot& knot, const Knot& next) {
  const float cosine = glm::dot(knot.along, next.along);
  const float reach = bend_reach(knot.radius, knot.room, next.room);
  return reach * (1.0f + cosine) > kRoomForArc * knot.radius * glm::length(knot.along - next.along) ||
         cosine < kSharp;
}

/// Radians; of a bend that turns less than a right angle within 2 %.
float turn_between(const Vec3f& a, const Vec3f& b) {
  const float chord = glm::length(a - b);  // 2 sin(turn / 2)
  return chord * (1.0f + chord * chord * (1.0f / 24.0f + chord * chord * (3.0f / 640.0f)));
}

}  // namespace

void measure(std::span<Knot> knots) {
  for (std::size_t i = 1; i < knots.size(); ++i) measure(knots, i);
}

std::uint32_t rings_in_bend(const Knot& knot, const Knot& next, float turn_max) {
  const Vec3f difference = knot.along - next.along;
  if (glm::dot(difference, difference) < turn_max * turn_max) return 1;
  return static_cast<std::uint32_t>(
      std::min(kRingsMax, 1.0f + std::ceil(turn_between(knot.along, next.along) / turn_max)));
}

std::uint32_t bands_of_taper(std::span<const Knot> knots, std::size_t i) {
  const bool has_collar = i == 1 && knots[1].room < knots[1].length;
  return has_collar ? 1 : bands_of_taper(double{knots[i - 1].radius}, double{knots[i].radius});
}

float bend_reach(float radius, float room_before, float room_after) {
  return std::min(kReachOfStretch * std::min(room_before, room_after), kReachOfRadius * radius);
}

void count_rings(std::span<Knot> knots, CentreLine line, float turn_max, float slack) {
  float turn_before = 0.0f;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    Knot& knot = knots[i];
    const bool is_last = i + 1 == knots.size();
    if (line == CentreLine::polyline) {
      knot.rings = is_last ? 1 : rings_in_bend(knot, knots[i + 1], turn_max);
      if (knot.rings > 1 && !has_room_for_arc(knot, knots[i + 1])) knot.rings = 1;
      if (knot.rings == 1 || slack <= 0.0f) continue;
      const float reach = bend_reach(knot.radius, knot.room, knots[i + 1].room);
      if (0.25f * reach * glm::length(knot.along - knots[i + 1].along) < slack) knot.rings = 1;
    } else {
      const float turn = is_last ? 0.0f : turn_between(knot.along, knots[i + 1].along);
      const float whole_turn = 0.75f * (turn_before + turn);
      knot.rings = static_cast<std::uint32_t>(std::clamp(std::ceil(whole_turn / turn_max), 1.0f, kRingsMax));
      const bool has_room = knot.room > kRoomForCurve * knots[i - 1].radius * std::max(turn_before, turn);
      if (!has_room || knot.length * (turn_before + turn) < 8.0f * slack) knot.rings = 1;
      turn_before = turn;
    }
  }
}

Vec3f spline_tangent(std::span<const Knot> knots, std::size_t i) {
  if (i + 1 == knots.size()) return knots[i].position - knots[i - 1].position;
  const Vec3f before = knots[i].position - knots[i - 1].position;
  const Vec3f after = knots[i + 1].position - knots[i].position;
  const float a = std::sqrt(std::max(knots[i].length, 1e-12f));
  const float b = std::sqrt(std::max(knots[i + 1].length, 1e-12f));
  return (before / a - (before + after) / (a + b) + after / b) * a;
}

void part_rings(std::vector<LinePoint>& points, std::size_t first) {
  for (std::size_t i = first; i < points.size(); ++i) {
    const LinePoint& before = points[i - 1];
    LinePoint& point = points[i];
    const Vec3f step = point.position - before.position;
    const float radius = kClearance * std::max(before.radius, point.radius);
    const Vec3f wanted = point.along;
    const Vec3f whole_turn = wanted - before.along;
    // Nearly all rings are this far apart.
    if (4.0f * radius * radius * glm::dot(whole_turn, whole_turn) < glm::dot(step, step)) continue;
    if (glm::dot(step, before.along) <= 0.0f) continue;
    for (float share = 1.0f; share > kLeastTurn; share *= 0.5f) {
      const Vec3f turn = point.along - before.along;
      const float needed = radius * glm::length(turn);
      if (glm::dot(step, before.along) >= needed && glm::dot(step, point.along) >= needed) break;
      point.along = normalized_or(glm::mix(before.along, wanted, 0.5f * share), wanted);
    }
  }
}

void trace_line(std::span<const Knot> knots, CentreLine line, bool parts_tapers,
                std::vector<LinePoint>& points) {
  add_point(points, knots[0].position, knots[0].along, knots[0].radius, knots[0].node);
  if (line == CentreLine::polyline) {
    trace_polyline(knots, parts_tapers, points);
  } else {
    trace_spline(knots, points);
  }
}

}  // namespace ramify
