#include "common/mesh/centre_line.h"

#include <algorithm>

namespace ramify {
namespace {

// Of a stretch: two neighbouring bends leave a little of it straight.
constexpr double kReachOfStretch = 0.45;

// In radii: a bend looks grown rather than broken, and does not close on its inner side.
constexpr double kReachOfRadius = 3.0;

// A full turn takes no more than these.
constexpr double kRingsMax = 24.0;

// Cosine beyond which a line turns back on itself: the arc then goes round sideways.
constexpr double kHairpin = -0.9;

/// Points of the quadratic Bezier curve with its control point at the knot: it leaves both stretches along
/// their own direction.
void round_bend(const Knot& before, const Knot& knot, const Knot& next, std::vector<LinePoint>& points) {
  const double reach = bend_reach(knot.radius, knot.room, next.room);
  const double radius_in = glm::mix(knot.radius, before.radius, reach / knot.length);
  const double radius_out = glm::mix(knot.radius, next.radius, reach / next.length);
  const bool is_hairpin = glm::dot(knot.along, next.along) < kHairpin;
  const Vec3 aside = is_hairpin ? any_perpendicular(knot.along) * reach : Vec3(0.0);
  for (std::uint32_t ring = 0; ring < knot.rings; ++ring) {
    const double t = ring / (knot.rings - 1.0);
    const double s = 1.0 - t;
    const Vec3 offset = knot.along * (-reach * s * s) + next.along * (reach * t * t) + aside * (4.0 * s * t);
    const Vec3 derivative = knot.along * s + next.along * t + aside * (2.0 / reach * (s - t));
    points.push_back({knot.position + offset, normalized_or(derivative, knot.along),
                      radius_in * s * s + knot.radius * 2.0 * s * t + radius_out * t * t, knot.node});
  }
}

void trace_polyline(std::span<const Knot> knots, std::vector<LinePoint>& points) {
  for (std::size_t i = 1; i + 1 < knots.size(); ++i) {
    const Knot& knot = knots[i];
    if (knot.rings > 1) {
      round_bend(knots[i - 1], knot, knots[i + 1], points);
    } else {
      points.push_back({knot.position, normalized_or(knot.along + knots[i + 1].along, knot.along),
                        knot.radius, knot.node});
    }
  }
  points.push_back({knots.back().position, knots.back().along, knots.back().radius, knots.back().node});
}

/// Cubic Hermite curves with the spline's tangents; the width changes evenly.
void trace_spline(std::span<const Knot> knots, std::vector<LinePoint>& points) {
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const Vec3 from = knots[i - 1].position;
    const Vec3 to = knots[i].position;
    // The tangent is continuous by direction and speed; the speed is by the share of each stretch.
    const Vec3 start = i == 1 ? to - from
                              : spline_tangent(knots, i - 1) *
                                    std::sqrt(knots[i].length / std::max(knots[i - 1].length, 1e-12));
    const Vec3 end = spline_tangent(knots, i);
    for (std::uint32_t ring = 1; ring <= knots[i].rings; ++ring) {
      const double t = static_cast<double>(ring) / knots[i].rings;
      const double s = 1.0 - t;
      const Vec3 position = from * (s * s * (1.0 + 2.0 * t)) + start * (s * s * t) +
                            to * (t * t * (3.0 - 2.0 * t)) - end * (t * t * s);
      const Vec3 derivative =
          (to - from) * (6.0 * s * t) + start * (s * (s - 2.0 * t)) + end * (t * (t - 2.0 * s));
      points.push_back({position, normalized_or(derivative, knots[i].along),
                        glm::mix(knots[i - 1].radius, knots[i].radius, t), knots[i].node});
    }
  }
}

/// Radians; of a bend that turns less than a right angle within 2 %.
double turn_between(const Vec3& a, const Vec3& b) {
  const double chord = glm::length(a - b);  // 2 sin(turn / 2)
  return chord * (1.0 + chord * chord * (1.0 / 24.0 + chord * chord * (3.0 / 640.0)));
}

}  // namespace

void measure(std::span<Knot> knots) {
  Vec3 along = kUp;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const Vec3 step = knots[i].position - knots[i - 1].position;
    knots[i].length = glm::length(step);
    knots[i].room = knots[i].length;
    if (knots[i].length > 1e-12) along = step / knots[i].length;
    knots[i].along = along;
  }
  knots[0].along = knots.size() > 1 ? knots[1].along : along;
}

std::uint32_t rings_in_bend(const Knot& knot, const Knot& next, double turn_max) {
  const Vec3 difference = knot.along - next.along;
  if (glm::dot(difference, difference) < turn_max * turn_max) return 1;
  return static_cast<std::uint32_t>(
      std::min(kRingsMax, 1.0 + std::ceil(turn_between(knot.along, next.along) / turn_max)));
}

double bend_reach(double radius, double room_before, double room_after) {
  return std::min(kReachOfStretch * std::min(room_before, room_after), kReachOfRadius * radius);
}

void count_rings(std::span<Knot> knots, CentreLine line, double turn_max, double slack) {
  double turn_before = 0.0;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    Knot& knot = knots[i];
    const bool is_last = i + 1 == knots.size();
    if (line == CentreLine::polyline) {
      knot.rings = is_last ? 1 : rings_in_bend(knot, knots[i + 1], turn_max);
      if (knot.rings == 1 || slack <= 0.0) continue;
      const double reach = bend_reach(knot.radius, knot.room, knots[i + 1].room);
      if (0.25 * reach * glm::length(knot.along - knots[i + 1].along) < slack) knot.rings = 1;
    } else {
      const double turn = is_last ? 0.0 : turn_between(knot.along, knots[i + 1].along);
      const double rings = std::ceil(0.75 * (turn_before + turn) / turn_max);
      knot.rings = static_cast<std::uint32_t>(std::clamp(rings, 1.0, kRingsMax));
      if (knot.length * (turn_before + turn) < 8.0 * slack) knot.rings = 1;
      turn_before = turn;
    }
  }
}

Vec3 spline_tangent(std::span<const Knot> knots, std::size_t i) {
  if (i + 1 == knots.size()) return knots[i].position - knots[i - 1].position;
  const Vec3 before = knots[i].position - knots[i - 1].position;
  const Vec3 after = knots[i + 1].position - knots[i].position;
  const double a = std::sqrt(std::max(knots[i].length, 1e-12));
  const double b = std::sqrt(std::max(knots[i + 1].length, 1e-12));
  return (before / a - (before + after) / (a + b) + after / b) * a;
}

void trace_line(std::span<const Knot> knots, CentreLine line, std::vector<LinePoint>& points) {
  points.push_back({knots[0].position, knots[0].along, knots[0].radius, knots[0].node});
  if (line == CentreLine::polyline) {
    trace_polyline(knots, points);
  } else {
    trace_spline(knots, points);
  }
}

}  // namespace ramify
