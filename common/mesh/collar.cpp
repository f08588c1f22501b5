#include "common/mesh/collar.h"

#include <algorithm>

namespace ramify {
namespace {

// In radii of the lateral: how far its collar spreads over the parent, and how far up it goes.
constexpr double kSpread = 0.7;
constexpr double kRise = 1.3;

// In the same: how far behind its middle a side of the lateral may come out of the parent.
constexpr double kLag = 2.0;

// What the first bend leaves of the stretch, and how far its ring leans back, in radii.
constexpr double kFree = 0.775;
constexpr double kLean = 0.3;

// A lateral that is thicker than this share of its parent meets it as if it were thinner: else its sides
// would pass the parent by.
constexpr double kThickest = 0.95;

// Laterals at a smaller angle leave the parent as if they had this one, as its sine.
constexpr double kLeastSine = 0.2;

/// Where the line on one side of the lateral comes out of the parent, metres along the lateral: the greater
/// root of |across(center + outwards r + along s)|^2 = R^2, across the parent's direction.
double exit_length(const Fork& fork, const Lateral& lateral, const Vec3& outwards) {
  const double radius = fork.radius * fork.inset;
  const double r = std::min(lateral.radius, kThickest * radius);
  const double cosine = glm::dot(lateral.along, fork.along);
  const double sine2 = std::max(1.0 - cosine * cosine, kLeastSine * kLeastSine);
  const double lean = glm::dot(outwards, fork.along);
  const double root =
      r * r * lean * lean * cosine * cosine - sine2 * (r * r * (1.0 - lean * lean) - radius * radius);
  return std::max(0.0, (r * lean * cosine + std::sqrt(std::max(0.0, root))) / sine2);
}

}  // namespace

SurfacePoint on_parent(const Fork& fork, const Vec3& point, const Vec3& fallback) {
  double height = glm::dot(point - fork.center, fork.along);
  if (fork.is_ground) height = std::max(height, 0.0);
  // The parent's line about the fork, and its tangent.
  const double run = std::max(glm::length(fork.run), 0.1);
  const double h = height / run;
  Vec3 axis = fork.center + fork.run * h;
  Vec3 tangent = fork.run;
  if (std::abs(h) < fork.reach) {
    axis += fork.bend * (0.25 * h * h / fork.reach);
    tangent += fork.bend * (0.5 * h / fork.reach);
  } else {
    axis += fork.bend * (0.5 * std::abs(h) - 0.25 * fork.reach);
    tangent += fork.bend * (h > 0.0 ? 0.5 : -0.5);
  }
  const double length2 = glm::dot(tangent, tangent);
  const auto across = [&](const Vec3& v) {
    return length2 > 1e-12 ? v - tangent * (glm::dot(v, tangent) / length2) : v;
  };
  const Vec3 sideways = normalized_or(across(fallback), any_perpendicular(fork.along));
  const Vec3 normal = normalized_or(across(point - axis), sideways, 1e-9);
  const double widening = height > 0.0 ? fork.widening_above : fork.widening_below;
  const double radius = std::max(fork.radius + widening * height, 0.1 * fork.radius);
  return {axis + normal * (radius * fork.inset), normal};
}

SurfacePoint CollarLine::at(double t) const {
  const double s = 1.0 - t;
  const Vec3 tangent = (crotch - foot) * s + (top - crotch) * t;
  Vec3 normal = foot_normal * s + top_normal * t;
  // Square to the curve between its ends; there, as the surfaces that it touches have it.
  const double squared = std::min(1.0, 4.0 * s * t);
  const double length2 = glm::dot(tangent, tangent);
  if (length2 > 1e-24) normal -= tangent * (squared * glm::dot(normal, tangent) / length2);
  return {foot * (s * s) + crotch * (2.0 * s * t) + top * (t * t), normalized_or(normal, top_normal)};
}

CollarLine collar_line(const Fork& fork, const Lateral& lateral, const Vec3& outwards) {
  // The next ring may lean a little.
  const double longest =
      std::min(kCollarShare * lateral.length, lateral.length * kFree - kLean * lateral.radius);
  const double exit = exit_length(fork, lateral, outwards);
  const double rise = std::min(exit + kRise * lateral.radius, longest);
  const double t = rise / lateral.length;
  const Vec3 edge = fork.center + outwards * lateral.radius;
  const SurfacePoint crotch = on_parent(fork, edge + lateral.along * std::min(exit, longest), outwards);
  const SurfacePoint foot =
      on_parent(fork, crotch.position + outwards * (kSpread * lateral.radius), outwards);

  // A line that has no room to rise, or comes out far behind the middle, would make a web: it stays inside.
  const double middle = exit_length(fork, {.along = lateral.along}, outwards);
  const double room = (longest - exit) / (kRise * lateral.radius);
  const double lag = (exit - middle) / (kLag * lateral.radius);
  const double outside = std::clamp(std::min(room, 2.0 - lag), 0.0, 1.0);
  CollarLine line;
  line.foot = glm::mix(edge + lateral.along * (0.4 * rise), foot.position, outside);
  line.crotch = glm::mix(edge + lateral.along * (0.7 * rise), crotch.position, outside);
  line.top = edge + lateral.along * rise + lateral.bow * (t * t * t - t * t);
  line.foot_normal = normalized_or(glm::mix(outwards, foot.normal, outside), outwards);
  line.top_normal = outwards;
  return line;
}

}  // namespace ramify
