#include "common/mesh/collar.h"

#include <algorithm>
#include <limits>

namespace ramify {
namespace {

// In radii of the lateral: how far its collar spreads over the parent, and how far up it goes.
constexpr double kSpread = 0.7;
constexpr double kRise = 1.3;

// In the same: how far behind its middle a side of the lateral may come out of the parent.
constexpr double kLag = 2.0;

// What the collar may take of the way to the next ring.
constexpr double kFreeShare = 0.95;

// The greatest of t^2 - t^3.
constexpr double kGreatestBow = 4.0 / 27.0;

// In radii of the parent: a place about the fork that its facets and its tip surround in all directions.
constexpr double kWellInside = 0.7;

// In radii of the parent: so far out from its axis begins what is hidden in it all round.
constexpr double kHidden = 0.6;

// The facets of a round tip pass its ball inside by this share, at its end.
constexpr double kTipInset = 0.15;

// Cosine of the angle to the fork up to which no ring of the parent leans enough to matter.
const double kStraight = std::cos(radians(10.0));

// In radii of the parent: a collar may be so much less deep in it than it is laid.
constexpr double kMayRise = 0.02;

// Folded lines spread so much less each time; after so many times the whole collar does not.
constexpr double kLessSpread = 0.6;
constexpr int kTries = 5;

// Cosine between a triangle's normal and its corners' below which it counts as folded.
constexpr double kFolded = 0.01;

// A lateral that is thicker than this share of its parent meets it as if it were thinner: else its sides
// would pass the parent by.
constexpr double kThickest = 0.95;

// In radii of the parent: so far a collar begins below facets that are known.
constexpr double kBelowFacets = 0.03;

// Laterals at a smaller angle leave the parent as if they had this one, as its sine.
constexpr double kLeastSine = 0.2;

/// Where the line on one side of the lateral comes out of the parent, metres along the lateral: the greater
/// root of |across(center + outwards r + along s)|^2 = R^2, across the parent's direction.
double exit_length(const Fork& fork, const Lateral& lateral, const Vec3& outwards) {
  if (fork.facets) return fork.facets->exit_length(fork.center + outwards * lateral.radius, lateral.along);
  const double radius = fork.radius * fork.inset;
  const double r = std::min(lateral.radius, kThickest * radius);
  const double cosine = glm::dot(lateral.along, fork.along);
  const double sine2 = std::max(1.0 - cosine * cosine, kLeastSine * kLeastSine);
  const double lean = glm::dot(outwards, fork.along);
  const double root =
      r * r * lean * lean * cosine * cosine - sine2 * (r * r * (1.0 - lean * lean) - radius * radius);
  return std::max(0.0, (r * lean * cosine + std::sqrt(std::max(0.0, root))) / sine2);
}

/// Whether a point that lies between two rings, which may lean, is farther than `most` of their radii from
/// their centers. The planes in between go through the line in which those of the rings meet.
bool is_outside(const LinePoint& low, const LinePoint& high, const Vec3f& point, float most) {
  const float above = glm::dot(point - low.position, low.along);
  const float below = glm::dot(high.position - point, high.along);
  if (above < 0.0f || below < 0.0f || above + below <= 0.0f) return false;
  const float share = above / (above + below);
  const float radius = most * glm::mix(low.radius, high.radius, share);
  const Vec3f apart = point - glm::mix(low.position, high.position, share);
  return glm::dot(apart, apart) > radius * radius;
}

/// The nearest point a little within the parent's facets.
SurfacePoint within_facets(const Fork& fork, const Vec3& point) {
  const BearerFacets::Point on = fork.facets->nearest(point);
  return {on.position - on.normal * (kBelowFacets * fork.radius), on.normal};
}

}  // namespace

SurfacePoint on_parent(const Fork& fork, const Vec3& point, const Vec3& fallback) {
  if (fork.facets) return within_facets(fork, point);
  Vec3 axis(fork.line[0].position);
  Vec3 tangent = fork.along;
  double radius = fork.line[0].radius;
  double least = std::numeric_limits<double>::infinity();
  bool is_tip = false;
  bool is_beyond = false;  // an end that is no tip
  for (std::size_t i = 1; i < fork.line.size(); ++i) {
    const Vec3 from(fork.line[i - 1].position);
    const Vec3 step = Vec3(fork.line[i].position) - from;
    const double length2 = glm::dot(step, step);
    if (length2 <= 0.0) continue;
    const double share = glm::dot(point - from, step) / length2;
    const double t = std::clamp(share, 0.0, 1.0);
    const Vec3 apart = point - from - step * t;
    const double distance2 = glm::dot(apart, apart);
    if (distance2 >= least) continue;
    least = distance2;
    axis = from + step * t;
    tangent = step;
    radius = glm::mix(double{fork.line[i - 1].radius}, double{fork.line[i].radius}, t);
    const bool is_after = i + 1 == fork.line.size() && share > 1.0;
    is_tip = is_after && fork.has_tip;
    is_beyond = (i == 1 && share < 0.0) || (is_after && !fork.has_tip);
  }
  const auto across = [&](const Vec3& v) {
    return v - tangent * (glm::dot(v, tangent) / glm::dot(tangent, tangent));
  };
  const Vec3 aside = is_beyond ? across(point - axis) : point - axis;
  const double distance = glm::length(aside);
  const Vec3 normal =
      distance > 1e-9 ? aside / distance : normalized_or(across(fallback), any_perpendicular(fork.along));
  if (is_tip) radius *= 1.0 - kTipInset * std::max(0.0, glm::dot(normal, glm::normalize(tangent)));
  return {axis + normal * (radius * fork.inset), normal};
}

bool may_stand_out(const Fork& fork, std::span<const Vec3f> feet) {
  const auto leans = [&](const LinePoint& ring) {
    return glm::dot(Vec3(ring.along), fork.along) < kStraight;
  };
  if (std::none_of(fork.line.begin(), fork.line.end(), leans)) return false;
  std::vector<LinePoint> rings = fork.line;
  part_rings(rings, 1);
  const auto most = static_cast<float>(fork.inset + kMayRise);
  for (std::size_t i = 1; i < rings.size(); ++i) {
    for (const Vec3f& foot : feet) {
      if (is_outside(rings[i - 1], rings[i], foot, most)) return true;
    }
  }
  return false;
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

CollarLine collar_line(const Fork& fork, const Lateral& lateral, const Vec3& outwards, double spread) {
  const double bowed_up = kGreatestBow * std::max(0.0, -glm::dot(lateral.bow, lateral.along));
  const double longest = std::min(kCollarShare * lateral.length,
                                  kFreeShare * std::max(lateral.free - bowed_up, 0.1 * lateral.length));
  const double exit = exit_length(fork, lateral, outwards);
  const double rise = std::min(exit + kRise * lateral.radius, longest);
  const double t = rise / lateral.length;
  const Vec3 edge = fork.center + outwards * lateral.radius;
  const SurfacePoint crotch = on_parent(fork, edge + lateral.along * std::min(exit, longest), outwards);
  const SurfacePoint foot =
      on_parent(fork, crotch.position + outwards * (kSpread * lateral.radius), outwards);

  // A line that has no room to rise, or comes out far behind the middle, would make a web: it stays inside.
  const double cosine = glm::dot(lateral.along, fork.along);
  const double middle =
      fork.radius * fork.inset / std::sqrt(std::max(1.0 - cosine * cosine, kLeastSine * kLeastSine));
  const double room = (longest - exit) / (kRise * lateral.radius);
  const double lag = (exit - middle) / (kLag * lateral.radius);
  const double outside = spread * std::clamp(std::min(room, 2.0 - lag), 0.0, 1.0);
  const double fork_radius = fork.radius * fork.inset;
  const Vec3 inside = fork.center + outwards * std::min(lateral.radius, kWellInside * fork_radius) +
                      lateral.along * (kHidden * std::min(exit, fork_radius));
  CollarLine line;
  line.foot = glm::mix(inside, foot.position, outside);
  if (fork.facets && fork.facets->nearest(line.foot).height > -kBelowFacets * fork.radius)
    line.foot = within_facets(fork, line.foot).position;
  line.crotch = glm::mix(edge + lateral.along * (0.7 * rise), crotch.position, outside);
  line.top = edge + lateral.along * rise + lateral.bow * (t * t * t - t * t);
  line.foot_normal = normalized_or(glm::mix(outwards, foot.normal, outside), outwards);
  const Vec3 tangent = lateral.along * lateral.length + lateral.bow * (3.0 * t * t - 2.0 * t);
  line.top_normal = normalized_or(
      outwards - tangent * (glm::dot(outwards, tangent) / glm::dot(tangent, tangent)), outwards);
  return line;
}

void Collar::lay(const Fork& fork, const Lateral& lateral, std::span<const Vec3> outwards,
                 std::uint32_t stretches) {
  spreads_.assign(outwards.size(), 1.0);
  lay_lines(fork, lateral, outwards, stretches);
  for (int attempt = 1; find_folds(stretches); ++attempt) {
    // What cannot be smoothed stays a plain tube, which has no folds.
    if (attempt > kTries) spreads_.assign(outwards.size(), 0.0);
    for (std::size_t i = 0; i < outwards.size(); ++i) {
      if (is_folded_[i]) spreads_[i] *= kLessSpread;
    }
    lay_lines(fork, lateral, outwards, stretches);
    if (attempt > kTries) return;
  }
}

void Collar::lay_lines(const Fork& fork, const Lateral& lateral, std::span<const Vec3> outwards,
                       std::uint32_t stretches) {
  lines.clear();
  points.clear();
  for (std::size_t i = 0; i < outwards.size(); ++i) {
    lines.push_back(collar_line(fork, lateral, outwards[i], spreads_[i]));
    for (std::uint32_t k = 0; k <= stretches; ++k)
      points.push_back(lines[i].at(static_cast<double>(k) / stretches));
  }
}

bool Collar::find_folds(std::uint32_t stretches) {
  const auto is_fold = [](const SurfacePoint& a, const SurfacePoint& b, const SurfacePoint& c) {
    const Vec3 across = glm::cross(b.position - a.position, c.position - a.position);
    const Vec3 normals = a.normal + b.normal + c.normal;
    const double facing = glm::dot(across, normals);
    return facing <= 0.0 ||
           facing * facing < kFolded * kFolded * glm::dot(across, across) * glm::dot(normals, normals);
  };
  is_folded_.assign(lines.size(), false);
  bool has_folds = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t next = (i + 1) % lines.size();
    const SurfacePoint* here = &points[i * (stretches + 1)];
    const SurfacePoint* there = &points[next * (stretches + 1)];
    for (std::uint32_t k = 0; k < stretches; ++k) {
      if (!is_fold(here[k], there[k], there[k + 1]) && !is_fold(here[k], there[k + 1], here[k + 1])) continue;
      is_folded_[i] = is_folded_[next] = has_folds = true;
    }
  }
  return has_folds;
}

}  // namespace ramify
