#include "common/mesh/root_flare.h"

#include <algorithm>
#include <array>

namespace ramify {
namespace {

// In radii of the trunk.
constexpr double kHeight = 3.5;

// Of a trunk's length: a seedling must not be all foot.
constexpr double kHeightOfLength = 0.2;

// Shares of the height at which rings stand: near the ground the outline bends most.
constexpr std::array kShares = {0.0, 0.06, 0.13, 0.21, 0.31, 0.43, 0.57, 0.75, 1.0};

// Rings that are nearer than this share of the height would add nothing.
constexpr double kApart = 0.03;

// Two waves of different number make lobes of uneven strength. Their sum lies in -1 .. 1.
constexpr int kLobes = 5;
constexpr int kUnevenness = 3;
constexpr double kLobesShare = 0.65;

LinePoint between(const LinePoint& a, const LinePoint& b, float t) {
  return {glm::mix(a.position, b.position, t), normalized_or(glm::mix(a.along, b.along, t), b.along),
          glm::mix(a.radius, b.radius, t), b.node};
}

}  // namespace

RootFlare::Widening RootFlare::at(double share, double angle) const {
  if (share >= 1.0) return {};
  const double low = 1.0 - share;
  // The whole foot widens steeply, its lobes run out higher up.
  const double whole = low * low * low * low;
  const double lobed = low * low * low;
  const double phase = 1.0;
  const double lobes =
      kLobesShare * std::cos(kLobes * angle) + (1.0 - kLobesShare) * std::cos(kUnevenness * angle + phase);
  const double lobes_by_angle = -kLobesShare * kLobes * std::sin(kLobes * angle) -
                                (1.0 - kLobesShare) * kUnevenness * std::sin(kUnevenness * angle + phase);
  constexpr double kWholeShare = 0.7;
  constexpr double kLobedShare = 0.3;
  return {1.0 + amount * (kWholeShare * whole + kLobedShare * lobed * lobes),
          -amount * (kWholeShare * 4.0 * low * low * low + kLobedShare * 3.0 * low * low * lobes),
          amount * kLobedShare * lobed * lobes_by_angle};
}

RootFlare flare_of(double radius, double length, double amount) {
  const double wanted = kHeight * radius;
  const double height = std::min(wanted, kHeightOfLength * length);
  return {height, amount * height / wanted};
}

void add_flare_points(const RootFlare& flare, std::vector<LinePoint>& points) {
  std::vector<LinePoint> all{points.front()};
  double from = 0.0;
  std::size_t next = 1;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double length = glm::distance(points[i].position, points[i - 1].position);
    for (; next < kShares.size() && kShares[next] * flare.height < from + length; ++next) {
      const double t = (kShares[next] * flare.height - from) / length;
      const double apart = kApart * flare.height;
      if (t * length > apart && (1.0 - t) * length > apart)
        all.push_back(between(points[i - 1], points[i], static_cast<float>(t)));
    }
    all.push_back(points[i]);
    from += length;
  }
  points = std::move(all);
}

}  // namespace ramify
