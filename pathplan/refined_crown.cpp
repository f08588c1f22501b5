#include "pathplan/refined_crown.h"

#include <algorithm>

#include "common/base/rng.h"
#include "pathplan/poisson_disc.h"

namespace ramify::pathplan {
namespace {

// The near end of a cone, in spacings of the nodes.
constexpr double kJointSpacings = 2.0;

// Branches leave the trunk above this share of its height.
constexpr double kLowestJoint = 0.4;

double distance_to_segment(const Vec3& point, const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from;
  const double share = glm::clamp(glm::dot(point - from, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::distance(point, from + share * along);
}

/// Where a branch to `target` leaves a trunk: on its axis, if it is a cylinder, at 45 degrees to it if that
/// is on its upper part; else at the root. A sphere above the trunk hangs on a cone as long as its radius.
Vec3 joint_on_trunk(const Level& level, const Vec3& root, const Vec3& target, double radius) {
  if (level.volume.parts.size() < 2 || level.volume.parts.front().shape != Shape::cylinder) return root;
  const Volume& trunk = level.volume.parts.front();
  const Vec3 axis = glm::normalize(trunk.direction);
  const Vec3 from_base = target - trunk.center;
  const double along = glm::dot(from_base, axis);
  const double across = std::max(radius, glm::length(from_base - along * axis));
  return trunk.center + axis * glm::clamp(along - across, kLowestJoint * trunk.height, trunk.height);
}

}  // namespace

RefinedCrown::RefinedCrown(const Level& level, const Refinement& refinement, const Vec3& root,
                           std::uint64_t seed)
    : has_trunk_(level.volume.shape == Shape::union_of && level.volume.parts.size() > 1) {
  // The first point is where all branches come from: no sphere is nearer to it than to another.
  const Volume crown = endpoint_region(level);
  const Box box = bounds(crown);
  const Vec3 foot(root.x, box.low.y, root.z);
  const Nodes centers = scatter_nodes(crown, foot, {.nodes = refinement.spheres + 1},
                                      Rng::stream(seed, Stream::spheres, 0).next());
  for (std::size_t i = 1; i < centers.position.size(); ++i) {
    const Vec3& center = centers.position[i];
    spheres_.push_back(
        {center, refinement.radius, joint_on_trunk(level, root, center, refinement.radius), 0.0});
  }
  join(level);
  if (has_trunk_) solids_.emplace_back(level.volume.parts.front());
  for (const Sphere& sphere : spheres_) {
    solids_.emplace_back(Volume{.shape = Shape::union_of, .parts = {sphere_of(sphere), cone_of(sphere)}});
  }
}

/// The cones' near ends follow from the spacing of the nodes, which follows from the volume, cones and all.
void RefinedCrown::join(const Level& level) {
  double cubic_metres = volume_of(level.volume);
  for (int round = 0; round < 3; ++round) {
    const double spacing = wanted_spacing({.nodes = level.nodes, .spacing = level.spacing}, cubic_metres);
    volume_ = {.shape = Shape::union_of};
    if (has_trunk_) volume_.parts.push_back(level.volume.parts.front());
    for (Sphere& sphere : spheres_) {
      sphere.joint_radius = std::max(sphere.joint_radius, kJointSpacings * spacing);
      volume_.parts.push_back(sphere_of(sphere));
      volume_.parts.push_back(cone_of(sphere));
    }
    cubic_metres = volume_of(volume_);
  }
}

Volume RefinedCrown::sphere_of(const Sphere& sphere) {
  return {.shape = Shape::sphere, .center = sphere.center, .radius = sphere.radius};
}

Volume RefinedCrown::cone_of(const Sphere& sphere) {
  const Vec3 along = sphere.center - sphere.joint;
  const double height = glm::length(along);
  const double far_radius = std::max(sphere.radius, sphere.joint_radius);
  return {.shape = Shape::revolution,
          .center = sphere.joint,
          .direction = along,
          .points = {{sphere.joint_radius, 0.0}, {far_radius, height}}};
}

std::uint32_t RefinedCrown::subvolume_of(const Vec3& point) const {
  const std::size_t first = has_trunk_ ? 1 : 0;
  if (has_trunk_ ? solids_.front().contains(point) : is_at_root(point)) return 0;
  std::uint32_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    if (!solids_[first + i].contains(point)) continue;
    const double distance = distance_to_segment(point, spheres_[i].joint, spheres_[i].center);
    if (distance >= least) continue;
    least = distance;
    nearest = static_cast<std::uint32_t>(i + 1);
  }
  return nearest;
}

/// Without a trunk: where all cones begin. Was this one sphere's, it would cut the others off.
bool RefinedCrown::is_at_root(const Vec3& point) const {
  const Sphere& any = spheres_.front();
  return glm::distance(point, any.joint) <= any.joint_radius;
}

bool RefinedCrown::is_in_sphere(const Vec3& point, std::uint32_t subvolume) const {
  const Sphere& sphere = spheres_[subvolume - 1];
  return glm::distance(point, sphere.center) <= sphere.radius;
}

}  // namespace ramify::pathplan
