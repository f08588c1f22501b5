// Vectors, boxes and rotations. World space is right-handed with +Y up; metres and radians.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>

namespace ramify {

using Vec2f = glm::vec2;
using Vec3 = glm::dvec3;
using Vec3f = glm::vec3;
using Coord = glm::ivec3;  // a voxel or grid cell

inline const Vec3 kUp{0.0, 1.0, 0.0};

constexpr double radians(double degrees) {
  return degrees * (std::numbers::pi / 180.0);
}
constexpr double degrees(double radians) {
  return radians * (180.0 / std::numbers::pi);
}

/// Axis-aligned box; empty until something is included.
struct Box {
  Vec3 low{std::numeric_limits<double>::infinity()};
  Vec3 high{-std::numeric_limits<double>::infinity()};

  void include(const Vec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  void include(const Box& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  bool is_empty() const { return !(low.x <= high.x && low.y <= high.y && low.z <= high.z); }
  Vec3 size() const { return high - low; }
  Vec3 center() const { return 0.5 * (low + high); }
};

// The functions below that are templates take Vec3 and Vec3f.

/// v / |v|, or `fallback` where v is shorter than `shortest`.
template <class V>
V normalized_or(const V& v, const V& fallback,
                typename V::value_type shortest = typename V::value_type(1e-6)) {
  const auto length = glm::length(v);
  return length < shortest ? fallback : v / length;
}

/// v turned by `angle` about the unit vector `axis` (Rodrigues' formula).
inline Vec3 rotated(const Vec3& v, const Vec3& axis, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return v * c + glm::cross(axis, v) * s + axis * (glm::dot(axis, v) * (1.0 - c));
}

/// A unit vector perpendicular to the unit vector `direction`; the same one for the same direction.
template <class V>
V any_perpendicular(const V& direction) {
  // The coordinate axis that `direction` leans to least keeps the cross product long.
  const V a = glm::abs(direction);
  const V axis = a.x <= a.y && a.x <= a.z ? V(1, 0, 0) : (a.y <= a.z ? V(0, 1, 0) : V(0, 0, 1));
  return glm::normalize(glm::cross(direction, axis));
}

/// The unit vector perpendicular to `direction` at `azimuth` about it, counted from any_perpendicular().
inline Vec3 perpendicular_at(const Vec3& direction, double azimuth) {
  const Vec3 reference = any_perpendicular(direction);
  return reference * std::cos(azimuth) + glm::cross(direction, reference) * std::sin(azimuth);
}

/// `normal` carried along a curve whose unit tangent turns from `from` to `to`, without twist
/// (parallel transport). Stays perpendicular to the tangent.
inline Vec3 transported(const Vec3& normal, const Vec3& from, const Vec3& to) {
  // The turn from a to b takes v to v - (a + b) (a + b).v / (1 + a.b) + 2 b (a.v): no angle is needed.
  const double cosine = glm::dot(from, to);
  Vec3 carried = normal;
  if (cosine > -1.0 + 1e-9) {
    const Vec3 sum = from + to;
    carried += to * (2.0 * glm::dot(from, normal)) - sum * (glm::dot(sum, normal) / (1.0 + cosine));
  }
  // Rounding would add up over thousands of rings.
  carried -= to * glm::dot(carried, to);
  return normalized_or(carried, any_perpendicular(to));
}

}  // namespace ramify
