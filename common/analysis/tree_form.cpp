#include <algorithm>
#include <cmath>

#include "common/analysis/anatomy.h"
#include "common/analysis/distances.h"
#include "common/analysis/measures.h"
#include "common/analysis/metrics.h"

namespace ramify {
namespace {

/// Azimuth of `direction` about the unit vector `about`: 0 on its upper side, for upright ones towards +X.
double azimuth_deg(const Vec3& direction, const Vec3& about) {
  constexpr double kUprightSine = 0.1;
  Vec3 reference = kUp - about * glm::dot(about, kUp);
  if (glm::length(reference) < kUprightSine) reference = Vec3(1, 0, 0) - about * about.x;
  reference = glm::normalize(reference);
  return degrees(
      std::atan2(glm::dot(direction, glm::cross(about, reference)), glm::dot(direction, reference)));
}

double axis_length(const Anatomy& stem, std::size_t axis) {
  const auto nodes = stem.axis(axis);
  return stem.path_lengths()[nodes.back()] - stem.path_lengths()[stem.skeleton().parent[nodes.front()]];
}

void add_branches(const Anatomy& stem, std::vector<OrderScatter>& scatter) {
  const Skeleton& s = stem.skeleton();
  const std::vector<std::optional<double>> angles = branching_angles_deg(stem);
  for (std::size_t axis = 0; axis < stem.axis_count(); ++axis) {
    if (!angles[axis]) continue;  // starts at a root, or nowhere
    const std::uint32_t founder = stem.axis(axis).front();
    const std::uint32_t bearer = stem.bearer(axis);
    const std::size_t bearing = stem.axis_of(bearer);
    const double base = stem.path_lengths()[s.parent[stem.axis(bearing).front()]];
    const double place = (stem.path_lengths()[bearer] - base) / axis_length(stem, bearing);
    scatter[stem.axis_order(axis)].branches.push_back(
        {*angles[axis], azimuth_deg(s.along(founder), glm::normalize(s.along(bearer))),
         axis_length(stem, axis), s.start_radius(founder), place});
  }
}

void add_segments(const Anatomy& stem, std::vector<OrderScatter>& scatter) {
  const Skeleton& s = stem.skeleton();
  for (std::size_t node = s.root_count(); node < s.node_count(); ++node) {
    const Vec3 along = s.along(node);
    const std::uint32_t base = s.parent[stem.axis(stem.axis_of(node)).front()];
    const double path = stem.path_lengths()[node];
    scatter[s.order[node]].segments.push_back({0.5 * s.diameter[node],
                                               degrees(std::atan2(along.y, std::hypot(along.x, along.z))),
                                               path - stem.path_lengths()[base], path});
  }
}

/// By the elder rule: at a fork the branch that reaches farthest from the root goes on, the others end.
std::vector<Bar> barcode_of(const Anatomy& stem) {
  const Skeleton& s = stem.skeleton();
  const std::vector<double>& path = stem.path_lengths();
  std::vector<double> reach(path);  // farthest tip beyond each node
  std::vector<Bar> bars;
  for (std::size_t node = s.node_count(); node-- > 0;) {
    const auto children = stem.children(node);
    if (children.empty()) continue;
    const auto farther = [&](std::uint32_t a, std::uint32_t b) { return reach[a] < reach[b]; };
    const std::uint32_t elder = *std::max_element(children.begin(), children.end(), farther);
    for (const std::uint32_t child : children) {
      if (child != elder) bars.push_back({reach[child], path[node]});
    }
    reach[node] = reach[elder];
    if (s.is_root(node)) bars.push_back({reach[node], 0.0});
  }
  return bars;
}

ShapeFeatures shape_of(const Anatomy& stem) {
  const Skeleton& s = stem.skeleton();
  if (stem.tips().empty()) return {};
  Metrics metrics;
  measure_size(stem, metrics);
  const auto count = static_cast<double>(stem.tips().size());
  Vec3 center(0.0);
  const auto from_root = [&](std::uint32_t tip) { return s.position[tip] - s.position[stem.root_of()[tip]]; };
  for (const std::uint32_t tip : stem.tips()) center += from_root(tip) / count;
  Vec3 squares(0.0);
  double mixed = 0.0;
  for (const std::uint32_t tip : stem.tips()) {
    const Vec3 p = from_root(tip) - center;
    squares += p * p / count;
    mixed += p.x * p.z / count;
  }
  // Eigenvalues of the horizontal covariance: the crown may be wider one way than the other.
  const double middle = 0.5 * (squares.x + squares.z);
  const double half_gap = std::hypot(0.5 * (squares.x - squares.z), mixed);
  return {*metrics.height,      *metrics.crown_radius,        std::max(center.y, 0.0),
          std::sqrt(squares.y), std::sqrt(middle + half_gap), std::sqrt(std::max(middle - half_gap, 0.0))};
}

}  // namespace

TreeForm form_of(const Skeleton& skeleton) {
  const Skeleton part = living_stem(skeleton);
  const Anatomy stem(part);
  TreeForm form;
  if (stem.tips().empty()) return form;
  form.scatter.resize(1u + *std::max_element(part.order.begin(), part.order.end()));
  add_branches(stem, form.scatter);
  add_segments(stem, form.scatter);
  form.barcode = barcode_of(stem);
  form.shape = shape_of(stem);
  return form;
}

}  // namespace ramify
