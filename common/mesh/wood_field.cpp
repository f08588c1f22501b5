#include "common/mesh/wood_field.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace ramify {
namespace {

// The zone of a fork reaches so many times farther than parent and blend together: the crotch of a narrow
// fork is that far from its node.
constexpr double kZone = 2.5;

// Of a zone's radius: from here on the blend fades.
constexpr double kFade = 0.5;

// Cosine of the angle to the stem up to which what starts at a root stands.
constexpr double kStanding = 0.5;

Distance nearest(std::span<const RoundCone> cones, std::span<const std::uint32_t> chosen, const Vec3& point) {
  Distance least{std::numeric_limits<double>::infinity(), kUp};
  for (const std::uint32_t index : chosen) {
    const Distance one = cones[index].distance(point);
    if (one.value < least.value) least = one;
  }
  return least;
}

/// Who follows whom on an axis, and the laterals of each node, among the internodes kept.
struct Branching {
  std::vector<std::uint32_t> continuation;
  std::vector<std::vector<std::uint32_t>> laterals;

  Branching(const Skeleton& skeleton, const std::vector<bool>& is_kept)
      : continuation(skeleton.node_count(), kNoParent), laterals(skeleton.node_count()) {
    for (std::uint32_t node = 0; node < skeleton.node_count(); ++node) {
      if (skeleton.is_root(node) || !is_kept[node]) continue;
      const std::uint32_t parent = skeleton.parent[node];
      if (skeleton.axis[node] == skeleton.axis[parent]) {
        continuation[parent] = node;
      } else {
        laterals[parent].push_back(node);
      }
    }
  }
};

/// The direction of the stem that goes on from the root, or of the only internode there; 0 for one that lies
/// flat on that plane.
Vec3 cut_at_root(const Skeleton& skeleton, const Branching& branching, std::uint32_t internode) {
  const std::uint32_t root = skeleton.parent[internode];
  std::uint32_t stem = branching.continuation[root];
  if (stem == kNoParent && branching.laterals[root].size() == 1) stem = internode;
  if (stem == kNoParent) return Vec3(0.0);
  const Vec3 up = normalized_or(skeleton.along(stem), Vec3(0.0), 1e-12);
  const Vec3 along = normalized_or(skeleton.along(internode), Vec3(0.0), 1e-12);
  return glm::dot(up, along) > kStanding ? up : Vec3(0.0);
}

/// Finds the forks of a field whose cones are made.
class ForkFinder {
 public:
  ForkFinder(const Skeleton& skeleton, const Branching& branching, const std::vector<std::uint32_t>& cone_of,
             double blend)
      : skeleton_(skeleton), branching_(branching), cone_of_(cone_of), blend_(blend) {}

  /// Each lateral of `node` with the axis it leaves, and with the other laterals.
  void add_forks(std::uint32_t node, std::vector<Fork>& forks) const {
    const std::vector<std::uint32_t>& laterals = branching_.laterals[node];
    for (std::size_t i = 0; i < laterals.size(); ++i) {
      const double radius = skeleton_.start_radius(laterals[i]);
      Fork fork = empty_fork(node, radius, 0.5 * skeleton_.diameter[node]);
      fork.cones = cones_upwards(laterals[i], fork);
      fork.others = cones_through(node, fork);
      if (!fork.others.empty()) forks.push_back(std::move(fork));
      for (std::size_t j = 0; j < i; ++j) {
        Fork sides = empty_fork(node, radius, skeleton_.start_radius(laterals[j]));
        sides.cones = cones_upwards(laterals[i], sides);
        sides.others = cones_upwards(laterals[j], sides);
        forks.push_back(std::move(sides));
      }
    }
  }

 private:
  Fork empty_fork(std::uint32_t node, double radius, double other_radius) const {
    Fork fork;
    fork.center = skeleton_.position[node];
    fork.blend = blend_ * std::min(radius, other_radius);
    fork.zone = kZone * (std::max(radius, other_radius) + fork.blend);
    return fork;
  }

  bool is_near(std::uint32_t node, const Fork& fork) const {
    return glm::length(skeleton_.position[node] - fork.center) < fork.zone + 0.5 * skeleton_.diameter[node];
  }

  std::vector<std::uint32_t> cones_upwards(std::uint32_t first, const Fork& fork) const {
    std::vector<std::uint32_t> result;
    for (std::uint32_t node = first; node != kNoParent; node = branching_.continuation[node]) {
      result.push_back(cone_of_[node]);
      if (!is_near(node, fork)) break;
    }
    return result;
  }

  std::vector<std::uint32_t> cones_through(std::uint32_t node, const Fork& fork) const {
    std::vector<std::uint32_t> result = cones_upwards(branching_.continuation[node], fork);
    for (std::uint32_t below = node; !skeleton_.is_root(below); below = skeleton_.parent[below]) {
      result.push_back(cone_of_[below]);
      const bool is_same_axis = skeleton_.axis[skeleton_.parent[below]] == skeleton_.axis[below];
      if (!is_same_axis || !is_near(skeleton_.parent[below], fork)) break;
    }
    return result;
  }

  const Skeleton& skeleton_;
  const Branching& branching_;
  const std::vector<std::uint32_t>& cone_of_;
  double blend_;
};

}  // namespace

RoundCone::RoundCone(const Vec3& base, double base_radius, const Vec3& tip, double tip_radius,
                     const Vec3& cut, std::uint32_t internode)
    : base_(base),
      base_radius_(base_radius),
      tip_radius_(tip_radius),
      cut_(cut),
      cut_at_(base),
      internode_(internode) {
  bounds_.include(base - base_radius);
  bounds_.include(base + base_radius);
  bounds_.include(tip - tip_radius);
  bounds_.include(tip + tip_radius);
  const double length = glm::length(tip - base);
  const double narrowing = base_radius - tip_radius;
  // Where one ball holds the other there is nothing but the larger.
  if (length <= std::abs(narrowing) * (1.0 + 1e-9) || length == 0.0) {
    if (narrowing < 0.0) {
      base_ = tip;
      base_radius_ = tip_radius;
    }
    return;
  }
  length_ = length;
  along_ = (tip - base) / length;
  sine_ = narrowing / length;
  cosine_ = std::sqrt(1.0 - sine_ * sine_);
}

Distance RoundCone::distance(const Vec3& point) const {
  const Vec3 apart = point - base_;
  const auto to_ball = [](const Vec3& from_center, double radius) {
    const double length = glm::length(from_center);
    return Distance{length - radius, length > 1e-12 ? from_center / length : kUp};
  };
  if (length_ == 0.0) return to_ball(apart, base_radius_);

  const double axial = glm::dot(apart, along_);
  const Vec3 outwards = apart - along_ * axial;
  const double radial = glm::length(outwards);
  // How far along the line that touches both balls: before it the base's ball is nearest, past it the tip's.
  const double touching = axial * cosine_ - radial * sine_;
  Distance result;
  if (touching < 0.0) {
    result = to_ball(apart, base_radius_);
  } else if (touching > length_ * cosine_) {
    result = to_ball(apart - along_ * length_, tip_radius_);
  } else {
    const Vec3 side = radial > 1e-12 ? outwards / radial : any_perpendicular(along_);
    result = {radial * cosine_ + axial * sine_ - base_radius_, side * cosine_ + along_ * sine_};
  }
  const double behind = glm::dot(cut_at_ - point, cut_);
  if (cut_ != Vec3(0.0) && behind > result.value) return {behind, -cut_};
  return result;
}

double WoodField::distance(const Fork& fork, const Vec3& point) const {
  const Distance a = nearest(cones, fork.cones, point);
  const Distance b = nearest(cones, fork.others, point);
  const double least = std::min(a.value, b.value);
  const double apart = std::abs(a.value - b.value);
  if (apart >= fork.blend) return least;
  // Surfaces that run alongside each other would bulge where they part: they meet at an angle or not at all.
  const double angle = std::clamp(1.0 - glm::dot(a.gradient, b.gradient), 0.0, 1.0);
  const double place = glm::length(point - fork.center) / fork.zone;
  const double faded = std::clamp((1.0 - place) / (1.0 - kFade), 0.0, 1.0);
  const double blend = fork.blend * angle * faded * faded * (3.0 - 2.0 * faded);
  if (apart >= blend) return least;
  const double overlap = blend - apart;
  return least - 0.25 * overlap * overlap / blend;
}

WoodField wood_field(const Skeleton& skeleton, const std::vector<bool>& is_kept, double blend) {
  const Branching branching(skeleton, is_kept);
  const std::size_t count = skeleton.node_count();
  WoodField field;
  field.cones.reserve(count);
  std::vector<std::uint32_t> cone_of(count, 0);
  for (std::uint32_t node = 0; node < count; ++node) {
    if (skeleton.is_root(node) || !is_kept[node]) continue;
    const std::uint32_t parent = skeleton.parent[node];
    const Vec3 cut = skeleton.is_root(parent) ? cut_at_root(skeleton, branching, node) : Vec3(0.0);
    cone_of[node] = static_cast<std::uint32_t>(field.cones.size());
    field.cones.emplace_back(skeleton.position[parent], skeleton.start_radius(node), skeleton.position[node],
                             0.5 * skeleton.diameter[node], cut, node);
  }
  if (blend > 0.0) {
    const ForkFinder finder(skeleton, branching, cone_of, blend);
    for (std::uint32_t node = 0; node < count; ++node) finder.add_forks(node, field.forks);
  }
  return field;
}

}  // namespace ramify
