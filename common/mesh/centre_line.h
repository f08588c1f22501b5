// The line that a tube is swept along, and where its rings stand: many in bends, few where it runs straight.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/geometry.h"
#include "common/mesh/axes.h"
#include "common/mesh/mesher.h"

namespace ramify {

// Shorter stretches have no direction of their own, metres.
constexpr float kLeastLength = 1e-12f;

/// A node of a tube, with the stretch that leads to it.
struct Knot {
  Vec3f position;
  Vec3f along{0.0f, 1.0f, 0.0f};  // unit, from the knot before; of the first knot, to the one after
  float length = 0.0f;            // from the knot before, metres
  float room = 0.0f;              // the part of it that bends may take
  float radius = 0.0f;
  std::uint32_t node = 0;
  std::uint32_t point = 0;  // of the axes
  std::uint32_t rings = 1;  // that the line needs at the knot, or on the stretch that leads to it
};

/// Where a ring stands.
struct LinePoint {
  Vec3f position;
  Vec3f along;  // unit tangent
  float radius = 0.0f;
  std::uint32_t node = 0;
};

/// Sets `along`, `length` and `room` of knots[i] and, if it is the second one, the first one's direction.
/// A knot in the place of the one before takes over its direction.
inline void measure(std::span<Knot> knots, std::size_t i) {
  Knot& knot = knots[i];
  const Vec3f step = knot.position - knots[i - 1].position;
  knot.length = glm::length(step);
  knot.room = knot.length;
  knot.along = knot.length > kLeastLength ? step / knot.length : knots[i - 1].along;
  if (i == 1) knots[0].along = knot.along;
}

/// Measures all knots but the first; with one knot there is nothing to measure.
void measure(std::span<Knot> knots);

/// Appends a point of the axes as a knot, measured.
inline void append_knot(std::vector<Knot>& knots, const Axes& axes, std::uint32_t point) {
  Knot& knot = knots.emplace_back();
  const AxisPoint& at = axes.points[point];
  knot.position = at.position;
  knot.radius = at.radius;
  knot.node = at.node;
  knot.point = point;
  if (knots.size() > 1) measure(knots, knots.size() - 1);
}

/// How many rings a knot needs between two stretches for the line to turn by no more than `turn_max` from one
/// to the next, radians.
std::uint32_t rings_in_bend(const Knot& knot, const Knot& next, float turn_max);

/// Sets `rings` of all knots. The bend at a knot of a polyline is an arc that cuts the corner by no more than
/// `slack`, metres, at a single ring.
void count_rings(std::span<Knot> knots, CentreLine line, float turn_max, float slack);

/// Bands of the stretch that leads to a knot, where its width may change much: a collar's is not parted.
std::uint32_t bands_of_taper(std::span<const Knot> knots, std::size_t i);

/// How far from a knot the line begins to turn, metres, where a polyline is rounded.
float bend_reach(float radius, float room_before, float room_after);

/// The derivative of a centripetal Catmull-Rom curve at the end of the stretch to knots[i], by the share of
/// that stretch.
/// E. Catmull, R. Rom, A class of local interpolating splines, 1974; C. Yuksel, S. Schaefer, J. Keyser,
/// Parameterization and applications of Catmull-Rom curves, Computer-Aided Design 43(7), 2011.
Vec3f spline_tangent(std::span<const Knot> knots, std::size_t i);

/// Turns the rings from `first` on by no more than what keeps each clear of the one before, on the inner side
/// of a bend too: what is left of a turn comes with the next ring. Where the line turns back there is no way.
void part_rings(std::vector<LinePoint>& points, std::size_t first);

/// Appends the points of the line to `points`, knots[0].rings = 1 point for the first knot. With
/// `parts_tapers` a polyline has more of them on stretches that taper much.
void trace_line(std::span<const Knot> knots, CentreLine line, bool parts_tapers,
                std::vector<LinePoint>& points);

}  // namespace ramify
