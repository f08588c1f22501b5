// Four vectors at a time, one in each lane, in the same terms as Vec3f. Roots take one instruction only in
// files that are compiled with -fno-math-errno.
#pragma once

#include <cmath>

#include "common/base/lanes.h"

namespace ramify {

struct Lanes3 {
  Lanes x;
  Lanes y;
  Lanes z;
};

inline Lanes3 operator+(const Lanes3& a, const Lanes3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Lanes3 operator*(const Lanes3& a, Lanes factor) {
  return {a.x * factor, a.y * factor, a.z * factor};
}
inline Lanes3 operator/(const Lanes3& a, Lanes divisor) {
  return {a.x / divisor, a.y / divisor, a.z / divisor};
}
inline Lanes dot(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Lanes3 cross(const Lanes3& a, const Lanes3& b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}

inline Lanes root(Lanes x) {
  for (std::size_t i = 0; i < kLanes; ++i) x[i] = std::sqrt(x[i]);
  return x;
}
inline Lanes length(const Lanes3& a) {
  return root(dot(a, a));
}

inline Lanes3 select(LaneMask condition, const Lanes3& a, const Lanes3& b) {
  return {condition ? a.x : b.x, condition ? a.y : b.y, condition ? a.z : b.z};
}

}  // namespace ramify
