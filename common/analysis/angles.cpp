#include <cmath>

#include "common/analysis/measures.h"
#include "common/analysis/statistics.h"

namespace ramify {
namespace {

// Shorter ones have no direction.
constexpr double kShortest = 1e-12;  // metres

std::optional<Vec3> direction(const Skeleton& s, std::size_t node) {
  const Vec3 along = s.along(node);
  const double length = glm::length(along);
  if (length < kShortest) return std::nullopt;
  return along / length;
}

/// A direction square to each internode, carried along its axis without twist; a new axis takes any.
std::vector<Vec3> references(const Anatomy& stem) {
  const Skeleton& s = stem.skeleton();
  std::vector<Vec3> carried(s.node_count(), Vec3(1, 0, 0));
  for (std::size_t index = 0; index < stem.axis_count(); ++index) {
    std::optional<Vec3> before;
    Vec3 reference(1, 0, 0);
    for (const std::uint32_t node : stem.axis(index)) {
      const std::optional<Vec3> now = direction(s, node);
      if (now) {
        reference = before ? transported(reference, *before, *now) : any_perpendicular(*now);
        before = now;
      }
      carried[node] = reference;
    }
  }
  return carried;
}

/// Mean step of azimuth between laterals that follow each other on one axis.
std::optional<double> divergence_mean_deg(const Anatomy& stem) {
  const std::vector<std::optional<double>> azimuth = azimuths_deg(stem);
  std::vector<double> steps;
  for (std::size_t bearing = 0; bearing < stem.axis_count(); ++bearing) {
    std::optional<double> before;
    for (const std::uint32_t node : stem.axis(bearing)) {
      for (const std::uint32_t child : stem.children(node)) {
        const std::size_t lateral = stem.axis_of(child);
        if (lateral == bearing || !azimuth[lateral]) continue;
        if (before) steps.push_back(std::abs(std::remainder(*azimuth[lateral] - *before, 360.0)));
        before = azimuth[lateral];
      }
    }
  }
  return mean(steps);
}

}  // namespace

std::vector<std::optional<double>> branching_angles_deg(const Anatomy& stem) {
  const Skeleton& s = stem.skeleton();
  std::vector<std::optional<double>> angles(stem.axis_count());
  for (std::size_t index = 0; index < stem.axis_count(); ++index) {
    if (stem.bearer(index) == kNoParent) continue;
    const std::optional<Vec3> own = direction(s, stem.axis(index).front());
    const std::optional<Vec3> bearer = direction(s, stem.bearer(index));
    if (!own || !bearer) continue;
    // The arc cosine would lose half the digits near 0 and 180.
    angles[index] = degrees(std::atan2(glm::length(glm::cross(*own, *bearer)), glm::dot(*own, *bearer)));
  }
  return angles;
}

std::vector<std::optional<double>> azimuths_deg(const Anatomy& stem) {
  constexpr double kLeastSine = 1e-9;  // of the angle between both
  const Skeleton& s = stem.skeleton();
  const std::vector<Vec3> reference = references(stem);
  std::vector<std::optional<double>> azimuths(stem.axis_count());
  for (std::size_t index = 0; index < stem.axis_count(); ++index) {
    const std::uint32_t bearer = stem.bearer(index);
    if (bearer == kNoParent) continue;
    const std::optional<Vec3> own = direction(s, stem.axis(index).front());
    const std::optional<Vec3> about = direction(s, bearer);
    if (!own || !about) continue;
    const double x = glm::dot(*own, reference[bearer]);
    const double y = glm::dot(*own, glm::cross(*about, reference[bearer]));
    if (std::hypot(x, y) > kLeastSine) azimuths[index] = degrees(std::atan2(y, x));
  }
  return azimuths;
}

void measure_angles(const Anatomy& stem, Metrics& metrics) {
  std::vector<double> angles;
  for (const std::optional<double>& angle : branching_angles_deg(stem)) {
    if (angle) angles.push_back(*angle);
  }
  metrics.branching_angle_mean_deg = mean(angles);
  metrics.branching_angle_sd_deg = standard_deviation(angles);
  metrics.divergence_angle_mean_deg = divergence_mean_deg(stem);
}

}  // namespace ramify
